// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/ParticleExchange.h"

#include "Bridge/Points/ParticleCells.h"
#include "Bridge/Ranks/CommonArrays.h"
#include "Bridge/Ranks/PlaceOwners.h"
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
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

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

// The tuples of a contiguous array, `each` a particle, for their ranks; zeros of one byte for
// nullptr.
std::vector<Bytes> pack(vtkDataArray* array, std::int64_t each, const std::vector<int>& owner,
  const std::vector<std::int64_t>& sent)
{
  const auto size = static_cast<std::size_t>(each) *
    (array ? static_cast<std::size_t>(array->GetNumberOfComponents()) *
          static_cast<std::size_t>(array->GetDataTypeSize())
           : 1);
  std::vector<Bytes> parts;
  std::vector<char*> next;
  for (const std::int64_t count : sent)
  {
    parts.emplace_back(static_cast<std::size_t>(count) * size);
    next.push_back(parts.back().data());
  }
  const auto* from = array ? static_cast<const char*>(array->GetVoidPointer(0)) : nullptr;
  for (std::size_t i = 0; from && i < owner.size(); ++i)
  {
    char*& to = next[static_cast<std::size_t>(owner[i])];
    to = std::copy_n(from + i * size, size, to);
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

// Array by array, as each is in memory twice meanwhile; the cells are made anew.
void moveToOwners(vtkPolyData* particles, std::int64_t points, const PlaceOwners& owners,
  const Ranks& ranks, Progress& progress)
{
  if (!ranks.AreSeveral())
  {
    return;
  }
  const std::vector<ArrayKind> kinds = commonArrays(particles, ranks);
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
  std::vector<Bytes> parts = pack(places, points, owner, sent);
  places = nullptr;
  parts = ranks.Exchange(std::move(parts));
  const std::int64_t size = 3 * points * made->GetDataTypeSize();
  std::vector<std::int64_t> counts; // of the particles that each rank sent here
  for (const Bytes& part : parts)
  {
    counts.push_back(static_cast<std::int64_t>(part.size()) / size);
  }
  const std::int64_t all = std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 });
  made->SetNumberOfTuples(static_cast<vtkIdType>(all * points));
  unpack(std::move(parts), points, counts, made);
  for (const ArrayKind& kind : kinds)
  {
    const std::int64_t each = kind.Owner == vtkDataObject::POINT ? points : 1;
    parts = pack(kind.Find(arrays), each, owner, sent);
    arrays->GetAttributes(kind.Owner)->RemoveArray(kind.Name.c_str());
    parts = ranks.Exchange(std::move(parts));
    unpack(
      std::move(parts), each, counts, kind.Make(particles, static_cast<vtkIdType>(all * each)));
  }
  setParticles(particles, made, points, progress);
}

void moveToOwners(vtkPolyData* particles, const ImageGrid& grid,
  vtkSmartPointer<vtkCellArray>& vertices, Progress& progress)
{
  const Ranks& ranks = progress.Group();
  if (ranks.AreSeveral())
  {
    moveToOwners(particles, 1, PlaceOwners(grid, nullptr, ranks), ranks, progress);
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
