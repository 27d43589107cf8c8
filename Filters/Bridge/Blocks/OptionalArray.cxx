// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/OptionalArray.h"

#include "Core/Messages/Failure.h"

#include "vtkAbstractArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringKey.h"

namespace RectifiedTransport::Bridge
{

bool isArrayAssociation(int association)
{
  return association == vtkDataObject::FIELD_ASSOCIATION_POINTS ||
    association == vtkDataObject::FIELD_ASSOCIATION_CELLS ||
    association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
}

void requireArrayAssociation(int association, const std::string& title)
{
  if (!isArrayAssociation(association))
  {
    fail("The field association of the ", title, " is ", association,
      "; it must be 0 (points), 1 (cells) or 3 (points, then cells)");
  }
}

OptionalArray findOptionalArray(vtkInformation* choice, vtkDataSet* data, const char* title)
{
  const int association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  const bool isAny = association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
  requireArrayAssociation(association, title);
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  const bool isAttribute = !name && choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  OptionalArray found;
  found.Name = name ? name : "";
  if (found.Name.empty() && !isAttribute)
  {
    return found;
  }
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    if (found.Array || (!isAny && owner != association))
    {
      continue;
    }
    vtkDataSetAttributes* arrays = data->GetAttributes(owner);
    found.OnPoints = owner == vtkDataObject::POINT;
    found.Array = isAttribute
      ? arrays->GetAbstractAttribute(choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
      : arrays->GetAbstractArray(found.Name.c_str());
  }
  found.IsChosen = found.Array || found.Name != "None";
  return found;
}

} // namespace RectifiedTransport::Bridge
