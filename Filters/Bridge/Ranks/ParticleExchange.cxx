// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/ParticleExchange.h"

#include "Bridge/Data/Cells/ParticleCells.h"
#include "Bridge/Ranks/CommonArrays.h"
#include "Bridge/Ranks/ImagePieces.h"
#include "Core/Geometry/Distributed/PlaceOwners.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Ranks.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

// The rank that owns the last of the `each` points of every particle: a path belongs to where it
// ends.
std::vector<int> findOwners(
  vtkDataArray* points, std::int64_t each, const PlaceOwners& owners, Progress& progress)
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
  return owner;
}

std::vector<std::int64_t> countOfEach(const std::vector<int>& owner, const Ranks& ranks)
{
  std::vector<std::int64_t> counts(static_cast<std::size_t>(ranks.Count()));
  for (const int rank : owner)
  {
    ++counts[static_cast<std::size_t>(rank)];
  }
  return counts;
}

} // namespace

// Array by array, as each is in memory twice meanwhile; the cells are made anew.
void moveToOwners(vtkPolyData* particles, std::int64_t points, const PlaceOwners& owners,
  const Ranks& ranks, Progress& progress)
{
  if (!ranks.AreSeveral())
  {
    return;
  }
  const ArrayKinds kinds = commonArrays(particles, ranks);
  vtkSmartPointer<vtkDataArray> places = particles->GetPoints()->GetData();
  const std::vector<int> owner = findOwners(places, points, owners, progress);
  const std::vector<std::int64_t> sent = countOfEach(owner, ranks);
  vtkNew<vtkPolyData> arrays;
  arrays->GetPointData()->ShallowCopy(particles->GetPointData());
  arrays->GetCellData()->ShallowCopy(particles->GetCellData());
  particles->Initialize();
  const auto made = vtkSmartPointer<vtkDataArray>::Take(places->NewInstance());
  made->SetName(places->GetName());
  made->SetNumberOfComponents(3);
  std::vector<Bytes> parts = packTuples(tuplesIn(places), points, owner, sent);
  places = nullptr;
  parts = ranks.Exchange(std::move(parts));
  const std::size_t received = std::accumulate(parts.begin(), parts.end(), std::size_t{ 0 },
    [](std::size_t sum, const Bytes& part) { return sum + part.size(); });
  const std::int64_t all =
    static_cast<std::int64_t>(received) / (3 * points * made->GetDataTypeSize());
  made->SetNumberOfTuples(static_cast<vtkIdType>(all * points));
  unpackTuples(std::move(parts), tuplesIn(made));
  for (const ArrayKind& kind : kinds)
  {
    const std::int64_t each = kind.Owner == vtkDataObject::POINT ? points : 1;
    parts = packTuples(tuplesIn(findArray(kind, arrays)), each, owner, sent);
    arrays->GetAttributes(kind.Owner)->RemoveArray(kind.Name.c_str());
    parts = ranks.Exchange(std::move(parts));
    unpackTuples(
      std::move(parts), tuplesIn(addArray(kind, particles, static_cast<vtkIdType>(all * each))));
  }
  setParticles(particles, made, points, progress);
}

void moveToOwners(vtkPolyData* particles, const ImageGrid& grid,
  vtkSmartPointer<vtkCellArray>& vertices, Progress& progress)
{
  const Ranks& ranks = progress.Group();
  if (ranks.AreSeveral())
  {
    moveToOwners(particles, 1, ownersOf(grid, nullptr, ranks), ranks, progress);
    return;
  }
  const vtkIdType count = particles->GetNumberOfPoints();
  if (!vertices || vertices->GetNumberOfCells() != count)
  {
    vertices = newParticleCells(count, 1, progress);
  }
  particles->SetVerts(vertices);
}

} // namespace RectifiedTransport::Bridge
