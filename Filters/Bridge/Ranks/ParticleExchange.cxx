// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/ParticleExchange.h"

#include "Bridge/Points/ParticleCells.h"
#include "Bridge/Ranks/PlaceOwners.h"
#include "Bridge/Ranks/SharedArrays.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

// The particles of each rank, as runs of particles.
std::vector<std::vector<TupleRun>> sortByOwner(vtkDataArray* points, std::int64_t each,
  const PlaceOwners& owners, const Ranks& ranks, Progress& progress)
{
  const std::int64_t count = points->GetNumberOfTuples() / each;
  std::vector<int> owner(static_cast<std::size_t>(count));
  progress.For(count, grain, [&](std::int64_t first, std::int64_t last) {
    double place[3];
    for (std::int64_t i = first; i < last; ++i)
    {
      points->GetTuple(i * each + each - 1, place);
      owner[static_cast<std::size_t>(i)] = owners.OwnerOf(place);
    }
  });
  std::vector<std::vector<TupleRun>> runs(static_cast<std::size_t>(ranks.Count()));
  for (std::int64_t i = 0; i < count; ++i)
  {
    std::vector<TupleRun>& those =
      runs[static_cast<std::size_t>(owner[static_cast<std::size_t>(i)])];
    if (!those.empty() && those.back().First + those.back().Count == i)
    {
      ++those.back().Count;
    }
    else
    {
      those.push_back({ static_cast<vtkIdType>(i), 1 });
    }
  }
  return runs;
}

std::vector<TupleRun> runsOfPoints(const std::vector<TupleRun>& particles, std::int64_t each)
{
  std::vector<TupleRun> points;
  points.reserve(particles.size());
  for (const TupleRun& run : particles)
  {
    points.push_back(
      { static_cast<vtkIdType>(run.First * each), static_cast<vtkIdType>(run.Count * each) });
  }
  return points;
}

} // namespace

void moveToOwners(vtkPolyData* particles, std::int64_t points, const PlaceOwners& owners,
  const Ranks& ranks, Progress& progress)
{
  const std::vector<ArrayKind> kinds = sharedArrays(particles, ranks);
  vtkDataArray* places = particles->GetPoints()->GetData();
  const auto sorted = sortByOwner(places, points, owners, ranks, progress);
  std::vector<Bytes> parts(sorted.size());
  for (std::size_t rank = 0; rank < sorted.size(); ++rank)
  {
    const std::vector<TupleRun> runs = runsOfPoints(sorted[rank], points);
    appendTuples(places, runs, parts[rank]);
    for (const ArrayKind& kind : kinds)
    {
      const bool isOfPoints = kind.Owner == vtkDataObject::POINT;
      appendTuples(kind.Find(particles), isOfPoints ? runs : sorted[rank], parts[rank]);
    }
  }
  // How many there are precedes their arrays.
  std::vector<std::int64_t> counts(parts.size());
  for (std::size_t rank = 0; rank < sorted.size(); ++rank)
  {
    for (const TupleRun& run : sorted[rank])
    {
      counts[rank] += run.Count;
    }
  }
  std::vector<Bytes> countBytes;
  for (const std::int64_t count : counts)
  {
    countBytes.push_back(toBytes(&count, 1));
  }
  counts.clear();
  std::int64_t all = 0;
  for (const Bytes& bytes : ranks.Exchange(std::move(countBytes)))
  {
    counts.push_back(fromBytes<std::int64_t>(bytes).front());
    all += counts.back();
  }

  const auto made = vtkSmartPointer<vtkDataArray>::Take(places->NewInstance());
  made->SetName(places->GetName());
  made->SetNumberOfComponents(3);
  particles->Initialize(); // all of it is in bytes now
  const std::vector<Bytes> received = ranks.Exchange(std::move(parts));

  made->SetNumberOfTuples(static_cast<vtkIdType>(all * points));
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  for (const ArrayKind& kind : kinds)
  {
    const bool isOfPoints = kind.Owner == vtkDataObject::POINT;
    arrays.push_back(kind.Make(particles, static_cast<vtkIdType>(all * (isOfPoints ? points : 1))));
  }
  vtkIdType first = 0;
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    const std::vector<TupleRun> ofCells = { { first, static_cast<vtkIdType>(counts[rank]) } };
    const std::vector<TupleRun> ofPoints = runsOfPoints(ofCells, points);
    const char* bytes = takeTuples(received[rank].data(), ofPoints, made);
    for (std::size_t i = 0; i < kinds.size(); ++i)
    {
      bytes =
        takeTuples(bytes, kinds[i].Owner == vtkDataObject::POINT ? ofPoints : ofCells, arrays[i]);
    }
    first += static_cast<vtkIdType>(counts[rank]);
  }
  vtkNew<vtkPoints> moved;
  moved->SetDataType(made->GetDataType());
  moved->SetData(made);
  particles->SetPoints(moved);
  const auto cells = newParticleCells(static_cast<vtkIdType>(all), points, progress);
  if (points > 1)
  {
    particles->SetLines(cells);
  }
  else
  {
    particles->SetVerts(cells);
  }
}

} // namespace RectifiedTransport
