// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/DistributedPoints.h"

#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Ranks/RankConsistency.h"
#include "Bridge/Ranks/TruncatedArrays.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Distributed/DuplicatePoints.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// The bits of the coordinates, or the global id.
PointIdentity identityOf(vtkPointSet* points, vtkIdType i, vtkDataArray* ids)
{
  // An id fills the first of the three words; the others are 0. Ranks agree on one kind of identity
  // for all points (see repeatedIn), so that ids are not compared with coordinates.
  PointIdentity identity{};
  if (ids)
  {
    identity[0] = static_cast<std::uint64_t>(ids->GetVariantValue(i).ToTypeInt64());
    return identity;
  }
  double place[3];
  points->GetPoint(i, place);
  std::memcpy(identity.data(), place, sizeof place);
  return identity;
}

// Whether some cell of a set connects points: a line, a face or a solid. Vertices alone mean
// particles.
bool connectsPoints(vtkPointSet* set)
{
  bool connects = false;
  for (vtkIdType cell = 0; cell < set->GetNumberOfCells() && !connects; ++cell)
  {
    const int type = set->GetCellType(cell);
    connects = type != VTK_EMPTY_CELL && type != VTK_VERTEX && type != VTK_POLY_VERTEX;
  }
  return connects;
}

// For each counted point of this rank whether a lower rank counts it, too: one of its global id, or
// else one at the same place. Empty for points that no line, face or cell connects on any rank:
// these are particles, of which two may be at one place.
std::vector<unsigned char> repeatedIn(
  vtkPointSet* own, const NonGhostPoints& counted, const Ranks& ranks)
{
  if (onAllRanks(ranks, !connectsPoints(own)))
  {
    return {};
  }
  vtkDataArray* ids = own->GetPointData()->GetGlobalIds();
  const bool isWhole = ids && ids->GetNumberOfTuples() >= own->GetNumberOfPoints();
  // Global ids serve only if every rank with points has one for each of its points.
  ids = onAllRanks(ranks, isWhole || counted.Count() == 0) ? ids : nullptr;
  return duplicatePoints(
    counted.Count(),
    [&](std::int64_t i) { return identityOf(own, static_cast<vtkIdType>(counted.Point(i)), ids); },
    ranks);
}

// The set itself, or an empty one in its place: where there is no input, where a data set has no
// vtkPoints object (VTK allows that), and on all ranks but the first if all hold the same data.
vtkSmartPointer<vtkPointSet> countedSet(vtkPointSet* own, const Ranks& ranks)
{
  // The comparison is collective: each rank makes it, also one without data.
  const bool isOne = ranks.AreSeveral() && areSameOnRanks(own, ranks) && !ranks.IsFirst();
  if (own && own->GetPoints() && !isOne)
  {
    return own;
  }
  const auto none = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  none->SetPoints(points);
  return none;
}

// Copies the integers of the counted points.
struct CopyIntegers
{
  template <class ArrayT>
  void operator()(ArrayT* array, const NonGhostPoints& counted, std::int64_t* to) const
  {
    const auto values = vtk::DataArrayValueRange<1>(array);
    for (std::int64_t i = 0; i < counted.Count(); ++i)
    {
      to[i] = static_cast<std::int64_t>(values[static_cast<vtkIdType>(counted.Point(i))]);
    }
  }
};

// Integer types of VTK in contiguous memory or not, dispatched to their own type: ids beyond 2^53
// are no doubles.
using Integers = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Integrals>;

// Those that may hold keys of a set, the preferred one first; nullptr for those that do not.
std::array<vtkDataArray*, 2> keyArrays(vtkPointSet* points)
{
  vtkPointData* data = points->GetPointData();
  std::array<vtkDataArray*, 2> arrays = { data->GetArray("SeedId"), data->GetGlobalIds() };
  const NonGhostPoints none(vtkNew<vtkPolyData>(), "input point set");
  for (vtkDataArray*& array : arrays)
  {
    // A copy of no values tells whether the dispatch knows the array's type.
    CopyIntegers copy;
    if (array &&
      (array->GetNumberOfComponents() != 1 ||
        array->GetNumberOfTuples() != points->GetNumberOfPoints() ||
        !Integers::Execute(array, copy, none, nullptr)))
    {
      array = nullptr;
    }
  }
  return arrays;
}

// The points without these flags that are not those of a lower rank, too.
NonGhostPoints countedOf(vtkPointSet* points, unsigned char ghosts, const Ranks& ranks)
{
  // Ghost flags come first: they cost no message.
  NonGhostPoints counted(points, "input point set", ghosts);
  // Particles, and their paths, have a number each.
  if (!ranks.AreSeveral() ||
    onAllRanks(ranks, points->GetNumberOfPoints() == 0 || keyArrays(points).front()))
  {
    return counted;
  }
  // About 100 bytes a point: identities of 24 bytes, sent, received and sorted. A flag for each
  // point of the set, with the bits `ghosts` for those that do not count.
  std::vector<unsigned char> left;
  withMemory({ "a comparison of the points of ranks",
               100.0 * static_cast<double>(points->GetNumberOfPoints()) },
    [&]() {
      const std::vector<unsigned char> repeated = repeatedIn(points, counted, ranks);
      left.assign(
        repeated.empty() ? 0 : static_cast<std::size_t>(points->GetNumberOfPoints()), ghosts);
      for (std::size_t i = 0; i < repeated.size(); ++i)
      {
        const std::int64_t point = counted.Point(static_cast<std::int64_t>(i));
        left[static_cast<std::size_t>(point)] = repeated[i] != 0 ? ghosts : 0;
      }
    });
  if (left.empty())
  {
    return counted;
  }
  return { points->GetNumberOfPoints(), left.data(), ghosts };
}

} // namespace

vtkSmartPointer<vtkPointSet> countedPoints(vtkPointSet* given, const Ranks& ranks)
{
  // On one rank the filter treats the ghosts of its input itself.
  if (!ranks.AreSeveral())
  {
    return given;
  }
  const vtkSmartPointer<vtkPointSet> set = countedSet(given, ranks);
  const NonGhostPoints counted = countedOf(set, vtkDataSetAttributes::DUPLICATEPOINT, ranks);
  const auto count = static_cast<vtkIdType>(counted.Count());
  // In the usual case all points count, and nothing is copied.
  if (count == set->GetNumberOfPoints())
  {
    return set;
  }
  // Arrays with fewer tuples than points cannot be copied by ids; they come back without tuples.
  const TruncatedArrays tooShort(set);
  const vtkSmartPointer<vtkPointSet> whole = tooShort.RemovedFrom(set.Get());
  vtkNew<vtkIdList> kept;
  kept->SetNumberOfIds(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    kept->SetId(i, static_cast<vtkIdType>(counted.Point(i)));
  }
  vtkSmartPointer<vtkPointSet> own;
  // The cells refer to points that do not count any more, so that each point gets a vertex.
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < count; ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  if (vtkPolyData::SafeDownCast(set))
  {
    const auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetVerts(vertices);
    own = surface;
  }
  else
  {
    const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetCells(VTK_VERTEX, vertices);
    own = grid;
  }
  copyPoints(whole, kept, own);
  // None of these points is a duplicate any more, but some may be hidden.
  const unsigned char* flags = ghostFlags(own, vtkDataObject::POINT, "input point set");
  if (flags && std::count(flags, flags + count, 0) == count)
  {
    own->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  }
  tooShort.AddEmptyTo(own);
  own->GetCellData()->Initialize(); // its cells are others
  return own;
}

DistributedPoints::DistributedPoints(vtkPointSet* own, unsigned char ghosts, const Ranks& ranks)
  : Points(countedSet(own, ranks))
  , Number(countedOf(this->Points, ghosts, ranks))
  , Total(sumOverRanks(ranks, this->Number.Count()))
{
  this->FindKeys(ranks);
}

void DistributedPoints::FindKeys(const Ranks& ranks)
{
  // The order on one rank is that of the points.
  if (!ranks.AreSeveral())
  {
    return;
  }
  // SeedId first, then global ids: the first array that all ranks with points have orders them.
  // Without one, the order is that of the ranks, and results may differ in the last bits from
  // those of one rank.
  for (vtkDataArray* array : keyArrays(this->Points))
  {
    if (onAllRanks(ranks, array != nullptr || this->Number.Count() == 0))
    {
      const std::int64_t count = this->Number.Count();
      withMemory({ "the order of points", sizeof(std::int64_t) * static_cast<double>(count) },
        [&]() { this->Order = LargeBuffer<std::int64_t>(count); });
      CopyIntegers copy;
      if (count > 0)
      {
        Integers::Execute(array, copy, this->Number, this->Order.data());
      }
      return;
    }
  }
}

vtkSmartPointer<vtkDataArray> DistributedPoints::TuplesOf(vtkDataArray* array) const
{
  if (this->Number.Count() == array->GetNumberOfTuples())
  {
    return array;
  }
  // An array of the same type and layout, one tuple for each counted point.
  const auto copy = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->SetNumberOfTuples(static_cast<vtkIdType>(this->Number.Count()));
  for (std::int64_t i = 0; i < this->Number.Count(); ++i)
  {
    copy->SetTuple(static_cast<vtkIdType>(i), static_cast<vtkIdType>(this->Number.Point(i)), array);
  }
  return copy;
}

} // namespace RectifiedTransport::Bridge
