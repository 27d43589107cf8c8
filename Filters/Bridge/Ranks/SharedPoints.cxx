// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/SharedPoints.h"

#include "Bridge/Ranks/RepeatedPoints.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/WholeInputs.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
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

#include <array>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

namespace
{

vtkSmartPointer<vtkPointSet> countedSet(vtkPointSet* own, const Ranks& ranks)
{
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
  void operator()(ArrayT* array, const CountedPoints& counted, std::int64_t* to) const
  {
    const auto values = vtk::DataArrayValueRange<1>(array);
    for (std::int64_t i = 0; i < counted.Count(); ++i)
    {
      to[i] = static_cast<std::int64_t>(values[static_cast<vtkIdType>(counted.Point(i))]);
    }
  }
};

using Integers = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Integrals>;

// Those that may hold keys of a set, the preferred one first; nullptr for those that do not.
std::array<vtkDataArray*, 2> keyArrays(vtkPointSet* points)
{
  vtkPointData* data = points->GetPointData();
  std::array<vtkDataArray*, 2> arrays = { data->GetArray("SeedId"), data->GetGlobalIds() };
  const CountedPoints none(vtkNew<vtkPolyData>(), "input point set");
  for (vtkDataArray*& array : arrays)
  {
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
CountedPoints countedOf(vtkPointSet* points, unsigned char ghosts, const Ranks& ranks)
{
  CountedPoints counted(points, "input point set", ghosts);
  // Particles, and their paths, have a number each.
  if (!ranks.AreSeveral() ||
    onAllRanks(ranks, points->GetNumberOfPoints() == 0 || keyArrays(points).front()))
  {
    return counted;
  }
  std::vector<unsigned char> left;
  withMemory("a comparison of the points of ranks",
    100.0 * static_cast<double>(points->GetNumberOfPoints()), [&]() {
      const std::vector<unsigned char> repeated = repeatedPoints(points, counted, ranks);
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
  if (!ranks.AreSeveral())
  {
    return given;
  }
  const vtkSmartPointer<vtkPointSet> set = countedSet(given, ranks);
  const CountedPoints counted = countedOf(set, vtkDataSetAttributes::DUPLICATEPOINT, ranks);
  const auto count = static_cast<vtkIdType>(counted.Count());
  if (count == set->GetNumberOfPoints())
  {
    return set;
  }
  vtkNew<vtkIdList> kept;
  kept->SetNumberOfIds(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    kept->SetId(i, static_cast<vtkIdType>(counted.Point(i)));
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(set->GetPoints()->GetDataType());
  set->GetPoints()->GetPoints(kept, points);
  vtkSmartPointer<vtkPointSet> own;
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
  own->SetPoints(points);
  own->GetPointData()->CopyAllOn();
  own->GetPointData()->CopyAllocate(set->GetPointData(), count);
  vtkNew<vtkIdList> places;
  places->SetNumberOfIds(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    places->SetId(i, i);
  }
  own->GetPointData()->CopyData(set->GetPointData(), kept, places);
  own->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  own->GetFieldData()->ShallowCopy(set->GetFieldData());
  return own;
}

SharedPoints::SharedPoints(vtkPointSet* own, unsigned char ghosts, const Ranks& ranks)
  : Points(countedSet(own, ranks))
  , Number(countedOf(this->Points, ghosts, ranks))
  , Total(sumOverRanks(ranks, this->Number.Count()))
{
  this->FindKeys(ranks);
}

void SharedPoints::FindKeys(const Ranks& ranks)
{
  if (!ranks.AreSeveral())
  {
    return;
  }
  for (vtkDataArray* array : keyArrays(this->Points))
  {
    if (onAllRanks(ranks, array != nullptr || this->Number.Count() == 0))
    {
      const std::int64_t count = this->Number.Count();
      withMemory("the order of points", sizeof(std::int64_t) * static_cast<double>(count),
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

vtkSmartPointer<vtkDataArray> SharedPoints::TuplesOf(vtkDataArray* array) const
{
  if (this->Number.Count() == array->GetNumberOfTuples())
  {
    return array;
  }
  const auto copy = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->SetNumberOfTuples(static_cast<vtkIdType>(this->Number.Count()));
  for (std::int64_t i = 0; i < this->Number.Count(); ++i)
  {
    copy->SetTuple(static_cast<vtkIdType>(i), static_cast<vtkIdType>(this->Number.Point(i)), array);
  }
  return copy;
}

} // namespace RectifiedTransport
