// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/DefaultArray.h"

#include "Core/Tables/Reading/IdNames.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"

namespace RectifiedTransport::Bridge
{

vtkDataSetAttributes* attributesOf(vtkDataSet* data, bool onPoints)
{
  return data->GetAttributes(onPoints ? vtkDataObject::POINT : vtkDataObject::CELL);
}

bool isIds(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  return array == attributes->GetGlobalIds() || array == attributes->GetPedigreeIds() ||
    isIdName(array->GetName() ? array->GetName() : "");
}

namespace
{

struct Arrays
{
  vtkDataArray* First = nullptr;
  int Count = 0; // numeric ones, ids and ghost flags aside
  int Ids = 0;   // and these
};

Arrays arraysOf(vtkDataSetAttributes* attributes)
{
  Arrays arrays;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = attributes->GetArray(i);
    if (array && isIds(attributes, array))
    {
      ++arrays.Ids;
    }
    else if (array)
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
    vtkDataArray* scalars = attributes->GetScalars();
    if (scalars && !isIds(attributes, scalars))
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

bool hasArrays(vtkDataSet* data)
{
  return arraysOf(data->GetAttributes(vtkDataObject::POINT)).Count > 0 ||
    arraysOf(data->GetAttributes(vtkDataObject::CELL)).Count > 0;
}

bool hasIds(vtkDataSet* data)
{
  return arraysOf(data->GetAttributes(vtkDataObject::POINT)).Ids > 0 ||
    arraysOf(data->GetAttributes(vtkDataObject::CELL)).Ids > 0;
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

} // namespace RectifiedTransport::Bridge
