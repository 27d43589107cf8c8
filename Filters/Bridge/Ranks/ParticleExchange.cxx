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
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <numeric>
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

// How many particles each rank sends here, of those that this rank sends to each.
std::vector<std::int64_t> exchangeCounts(
  const std::vector<std::vector<TupleRun>>& sorted, const Ranks& ranks)
{
  std::vector<Bytes> sent;
  for (const std::vector<TupleRun>& runs : sorted)
  {
    std::int64_t count = 0;
    for (const TupleRun& run : runs)
    {
      count += run.Count;
    }
    sent.push_back(toBytes(&count, 1));
  }
  std::vector<std::int64_t> counts;
  for (const Bytes& bytes : ranks.Exchange(std::move(sent)))
  {
    counts.push_back(fromBytes<std::int64_t>(bytes).front());
  }
  return counts;
}

// The tuples of an array, `each` a particle, for their ranks.
std::vector<Bytes> pack(
  vtkDataArray* array, std::int64_t each, const std::vector<std::vector<TupleRun>>& sorted)
{
  std::vector<Bytes> parts(sorted.size());
  for (std::size_t rank = 0; rank < sorted.size(); ++rank)
  {
    appendTuples(array, runsOfPoints(sorted[rank], each), parts[rank]);
  }
  return parts;
}

void unpack(std::vector<Bytes> received, std::int64_t each, const std::vector<std::int64_t>& counts,
  vtkDataArray* array)
{
  vtkIdType first = 0;
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    const auto length = static_cast<vtkIdType>(counts[rank] * each);
    takeTuples(received[rank].data(), { { first, length } }, array);
    received[rank] = Bytes();
    first += length;
  }
}

} // namespace

// Array by array, as each is in memory twice meanwhile.
void moveToOwners(vtkPolyData* particles, std::int64_t points, const PlaceOwners& owners,
  const Ranks& ranks, Progress& progress)
{
  const std::vector<ArrayKind> kinds = sharedArrays(particles, ranks);
  vtkDataArray* places = particles->GetPoints()->GetData();
  const auto sorted = sortByOwner(places, points, owners, ranks, progress);
  const std::vector<std::int64_t> counts = exchangeCounts(sorted, ranks);
  const std::int64_t all = std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 });
  vtkNew<vtkPolyData> arrays;
  arrays->ShallowCopy(particles);
  particles->Initialize();
  const auto made = vtkSmartPointer<vtkDataArray>::Take(places->NewInstance());
  made->SetName(places->GetName());
  made->SetNumberOfComponents(3);
  std::vector<Bytes> parts = pack(places, points, sorted);
  arrays->SetPoints(nullptr);
  parts = ranks.Exchange(std::move(parts));
  made->SetNumberOfTuples(static_cast<vtkIdType>(all * points));
  unpack(std::move(parts), points, counts, made);
  vtkNew<vtkPoints> moved;
  moved->SetDataType(made->GetDataType());
  moved->SetData(made);
  particles->SetPoints(moved);
  for (const ArrayKind& kind : kinds)
  {
    const std::int64_t each = kind.Owner == vtkDataObject::POINT ? points : 1;
    parts = pack(kind.Find(arrays), each, sorted);
    arrays->GetAttributes(kind.Owner)->RemoveArray(kind.Name.c_str());
    parts = ranks.Exchange(std::move(parts));
    unpack(
      std::move(parts), each, counts, kind.Make(particles, static_cast<vtkIdType>(all * each)));
  }
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
