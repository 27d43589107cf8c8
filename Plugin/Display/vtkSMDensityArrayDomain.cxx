// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkSMDensityArrayDomain.h"

#include "Bridge/Image/IdNames.h"
#include "Display/ClassByName.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

#include <string>

vtkStandardNewMacro(vtkSMDensityArrayDomain);

namespace
{

// Of SetInputArrayToProcess.
constexpr unsigned int elements = 5;
constexpr unsigned int nameElement = 4;

struct Choice
{
  int Association = -1; // none
  std::string Name;
};

// How an array of the data is used: a vtkDataSetAttributes::AttributeTypes, or -1.
int attributeOf(vtkPVDataInformation* data, int association, const std::string& name)
{
  vtkPVDataSetAttributesInformation* arrays = data->GetAttributeInformation(association);
  for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkPVArrayInformation* array = arrays->GetArrayInformation(i);
    if (array && array->GetName() && name == array->GetName())
    {
      return arrays->IsArrayAnAttribute(i);
    }
  }
  return -1;
}

// The active scalars, or else the first array that all blocks have, or else the first one; neither
// ids nor flags.
Choice choose(vtkSMArrayListDomain* list, vtkPVDataInformation* data)
{
  Choice first;
  Choice partial;
  for (unsigned int i = 0; i < list->GetNumberOfStrings(); ++i)
  {
    const std::string name = list->GetString(i);
    const int association = list->GetDomainAssociation(i);
    const int attribute = attributeOf(data, association, name);
    if (attribute == vtkDataSetAttributes::GLOBALIDS ||
      attribute == vtkDataSetAttributes::PEDIGREEIDS || RectifiedTransport::isIdName(name))
    {
      continue;
    }
    if (attribute == vtkDataSetAttributes::SCALARS)
    {
      return { list->GetFieldAssociation(i), name };
    }
    Choice& rest = list->IsArrayPartial(i) ? partial : first;
    if (rest.Association < 0)
    {
      rest = { list->GetFieldAssociation(i), name };
    }
  }
  return first.Association < 0 ? partial : first;
}

} // namespace

void vtkSMDensityArrayDomain::Update(vtkSMProperty* requestingProperty)
{
  this->Superclass::Update(requestingProperty);
  vtkSMProperty* property = this->GetProperty();
  vtkSMProperty* input = this->GetRequiredProperty("Input");
  if (!property || !input || this->GetNumberOfStrings() == 0)
  {
    return;
  }
  vtkSMPropertyHelper given(input, true);
  vtkSMPropertyHelper chosen(input, true);
  chosen.SetUseUnchecked(true);
  vtkSMPropertyHelper name(property, true);
  name.SetUseUnchecked(true);
  unsigned int place = 0;
  if (chosen.GetAsProxy() != given.GetAsProxy() && name.GetNumberOfElements() == elements &&
    !this->IsInDomain(name.GetAsString(nameElement), place))
  {
    this->SetDefaultValues(property, true);
  }
}

int vtkSMDensityArrayDomain::SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues)
{
  vtkPVDataInformation* data = this->GetInputDataInformation("Input");
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(useUncheckedValues);
  if (!data || this->GetNumberOfStrings() == 0 || helper.GetNumberOfElements() != elements)
  {
    return 0;
  }
  const Choice choice = choose(this, data);
  if (choice.Association >= 0)
  {
    helper.Set(nameElement - 1, std::to_string(choice.Association).c_str());
  }
  helper.Set(nameElement, choice.Name.c_str()); // none where all are ids or flags
  return 1;
}

bool vtkSMDensityArrayDomain::IsFilteredArray(vtkPVDataInformation*, int, const char* name)
{
  return name && std::string(name) == vtkDataSetAttributes::GhostArrayName();
}

namespace
{

const bool isRegistered =
  RectifiedTransport::registerClass<vtkSMDensityArrayDomain>("vtkSMDensityArrayDomain");

} // namespace
