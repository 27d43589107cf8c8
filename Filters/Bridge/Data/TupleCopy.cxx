// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/TupleCopy.h"

#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"

#include "vtkAbstractArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

std::string titleOf(vtkAbstractArray* array)
{
  return array->GetName() ? "array '" + std::string(array->GetName()) + "'" : "array without name";
}

} // namespace

void requireTuples(
  vtkAbstractArray* array, vtkIdType count, const std::string& owner, const std::string& name)
{
  if (array->GetNumberOfTuples() < count)
  {
    throw Failure("The " + owner + " " + titleOf(array) + " of the " + name + " has " +
      std::to_string(array->GetNumberOfTuples()) + " tuples; it must have one for each of the " +
      std::to_string(count) + " " + owner + "s");
  }
}

void requireTuples(vtkDataSet* data, const std::string& name)
{
  for (const int type : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(type);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      requireTuples(attributes->GetAbstractArray(i), data->GetNumberOfElements(type),
        type == vtkDataObject::CELL ? "cell" : "point", name);
    }
  }
}

void copyTuples(const TupleSource& source, std::int64_t count,
  const std::function<vtkIdType(vtkIdType)>& idOf, vtkDataSetAttributes* to, Progress& progress)
{
  for (int i = 0; i < source.From->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = source.From->GetAbstractArray(i);
    requireTuples(array, source.Count, source.Owner, source.Name);
    requireMemory({ "the " + titleOf(array),
      static_cast<double>(count) * array->GetNumberOfComponents() *
        std::max(1, array->GetDataTypeSize()) });
  }
  to->CopyAllocate(source.From, static_cast<vtkIdType>(count));
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  constexpr std::int64_t units = std::int64_t{ 1 } << 16; // with random memory access
  progress.ForInOrder(
    count, grain,
    [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<vtkIdType>(first); i < last; ++i)
      {
        to->CopyData(source.From, idOf(i), i);
      }
    },
    units);
}

void copyPoints(vtkPointSet* from, vtkIdList* ids, vtkPointSet* to)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(from->GetPoints()->GetDataType());
  from->GetPoints()->GetPoints(ids, points);
  to->SetPoints(points);
  to->GetPointData()->CopyAllOn();
  to->GetPointData()->CopyAllocate(from->GetPointData(), ids->GetNumberOfIds());
  to->GetPointData()->CopyData(from->GetPointData(), ids);
  to->GetFieldData()->ShallowCopy(from->GetFieldData());
}

} // namespace RectifiedTransport::Bridge
