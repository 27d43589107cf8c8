// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/CommonArrays.h"

#include "Bridge/Data/TupleCopy.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <cstddef>
#include <string>

namespace RectifiedTransport::Bridge
{

static_assert(OfPoints == +vtkDataObject::POINT && OfCells == +vtkDataObject::CELL, "as in VTK");

namespace
{

ArrayKinds kindsOf(vtkDataSet* data)
{
  ArrayKinds kinds;
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      if (!array || !array->GetName())
      {
        continue;
      }
      requireTuples(array, data->GetNumberOfElements(owner),
        owner == vtkDataObject::CELL ? "cell" : "point", "input");
      ArrayKind kind = kindOf(attributes, i, owner);
      // Bits have no bytes of their own.
      kind.Type = kind.Type == VTK_BIT ? VTK_UNSIGNED_CHAR : kind.Type;
      for (int c = 0; array->HasAComponentName() && c < kind.Components; ++c)
      {
        const char* name = array->GetComponentName(c);
        kind.ComponentNames.emplace_back(name ? name : "");
      }
      kinds.push_back(kind);
    }
  }
  return kinds;
}

} // namespace

ArrayKind kindOf(vtkDataSetAttributes* attributes, int array, int owner)
{
  vtkAbstractArray* given = attributes->GetAbstractArray(array);
  return { owner, given->GetDataType(), given->GetNumberOfComponents(),
    attributes->IsArrayAnAttribute(array), given->GetName() ? given->GetName() : "" };
}

bool isGhosts(const ArrayKind& kind)
{
  return kind.Name == vtkDataSetAttributes::GhostArrayName();
}

vtkSmartPointer<vtkDataArray> findArray(const ArrayKind& kind, vtkDataSet* data)
{
  vtkDataArray* array =
    data ? data->GetAttributes(kind.Owner)->GetArray(kind.Name.c_str()) : nullptr;
  if (!array || (array->HasStandardMemoryLayout() && array->GetDataType() == kind.Type))
  {
    return array;
  }
  const auto copy = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(kind.Type));
  copy->DeepCopy(array);
  return copy;
}

vtkSmartPointer<vtkDataArray> addArray(const ArrayKind& kind, vtkDataSet* data, vtkIdType tuples)
{
  const auto array =
    vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(kind.Type));
  array->SetName(kind.Name.c_str());
  array->SetNumberOfComponents(kind.Components);
  for (std::size_t c = 0; c < kind.ComponentNames.size(); ++c)
  {
    array->SetComponentName(static_cast<vtkIdType>(c), kind.ComponentNames[c].c_str());
  }
  array->SetNumberOfTuples(tuples);
  vtkDataSetAttributes* attributes = data->GetAttributes(kind.Owner);
  const int index = attributes->AddArray(array);
  if (kind.Attribute >= 0)
  {
    attributes->SetActiveAttribute(index, kind.Attribute);
  }
  return vtkDataArray::SafeDownCast(array);
}

ArrayKinds commonArrays(vtkDataSet* data, const Ranks& ranks)
{
  // A first letter tells whether there are data.
  const bool hasData = data && data->GetNumberOfPoints() > 0;
  std::vector<ArrayKinds> all;
  for (const std::string& text :
    gatherTexts(ranks, hasData ? "+" + textOfKinds(kindsOf(data)) : std::string()))
  {
    if (!text.empty())
    {
      all.push_back(kindsOfText(text.substr(1)));
    }
  }
  return commonKinds(all, vtkDataSetAttributes::GhostArrayName());
}

TupleMemory tuplesIn(vtkDataArray* array)
{
  return array ? TupleMemory{ static_cast<char*>(array->GetVoidPointer(0)),
    static_cast<std::size_t>(array->GetDataTypeSize()) *
      static_cast<std::size_t>(array->GetNumberOfComponents()) }
               : TupleMemory{};
}

} // namespace RectifiedTransport::Bridge
