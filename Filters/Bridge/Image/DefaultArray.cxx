// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Image/DefaultArray.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"

namespace RectifiedTransport
{

namespace
{

struct Arrays
{
  vtkDataArray* First = nullptr;
  int Count = 0; // numeric ones, ghost flags aside
};

Arrays arraysOf(vtkDataSetAttributes* attributes)
{
  Arrays arrays;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = attributes->GetArray(i);
    if (array && array != attributes->GetArray(vtkDataSetAttributes::GhostArrayName()))
    {
      arrays.First = arrays.First ? arrays.First : array;
      ++arrays.Count;
    }
  }
  return arrays;
}

} // namespace

vtkDataArray* defaultArray(vtkDataSet* data, int& association)
{
  vtkDataArray* only = nullptr;
  int count = 0;
  for (const int owner :
    { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(owner);
    if (vtkDataArray* scalars = attributes->GetScalars())
    {
      association = owner;
      return scalars;
    }
    const Arrays arrays = arraysOf(attributes);
    if (arrays.Count > 0)
    {
      association = owner;
      only = arrays.First;
      count += arrays.Count;
    }
  }
  return count == 1 ? only : nullptr;
}

bool hasPointValues(vtkDataSet* data)
{
  int association = vtkDataObject::FIELD_ASSOCIATION_NONE;
  return defaultArray(data, association)
    ? association == vtkDataObject::FIELD_ASSOCIATION_POINTS
    : arraysOf(data->GetAttributes(vtkDataObject::POINT)).Count > 0;
}

bool announcesScalars(vtkInformation* information, int association)
{
  return vtkDataObject::GetActiveFieldInformation(
           information, association, vtkDataSetAttributes::SCALARS) != nullptr;
}

} // namespace RectifiedTransport
