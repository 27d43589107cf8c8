// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkSMDensityArrayDomain.h"

#include "Core/Tables/Reading/IdNames.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

vtkStandardNewMacro(vtkSMDensityArrayDomain);

namespace
{

// SetInputArrayToProcess has five elements: index, port, connection, association and name.
constexpr unsigned int elements = 5;
constexpr unsigned int nameElement = 4;

struct Choice
{
  int Association = -1; // none
  std::string Name;
};

struct ArrayUse
{
  int Attribute = -1; // a vtkDataSetAttributes::AttributeTypes
  int Components = 1;
  bool IsText = false;
};

ArrayUse useOf(vtkPVDataInformation* data, int association, const std::string& name)
{
  vtkPVDataSetAttributesInformation* arrays = data->GetAttributeInformation(association);
  for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkPVArrayInformation* array = arrays->GetArrayInformation(i);
    if (array && array->GetName() && name == array->GetName())
    {
      const int type = array->GetDataType();
      return { arrays->IsArrayAnAttribute(i), array->GetNumberOfComponents(),
        type == VTK_STRING || type == VTK_VARIANT };
    }
  }
  return {};
}

// An array of the namesake, if there is one, or if `hasRun` the active scalars: what a filter
// without a name takes. An array of one component before one of several. Then the active scalars,
// or else the first array that all blocks have, or else the first one. Neither ids, flags nor text.
Choice choose(
  vtkSMArrayListDomain* list, vtkPVDataInformation* data, const std::string& namesake, bool hasRun)
{
  constexpr int ranks = 7;
  std::array<Choice, ranks> first;
  for (unsigned int i = 0; i < list->GetNumberOfStrings(); ++i)
  {
    const std::string name = list->GetString(i);
    const ArrayUse use = useOf(data, list->GetDomainAssociation(i), name);
    if (use.Attribute == vtkDataSetAttributes::GLOBALIDS ||
      use.Attribute == vtkDataSetAttributes::PEDIGREEIDS || use.IsText ||
      RectifiedTransport::isIdName(name))
    {
      continue;
    }
    const std::size_t rest = use.Attribute == vtkDataSetAttributes::SCALARS ? 1
      : list->IsArrayPartial(i)                                             ? 3
                                                                            : 2;
    const bool isTaken = name == namesake || (hasRun && rest == 1);
    Choice& choice = first[isTaken ? 0 : rest + (use.Components > 1 ? ranks / 2 : 0)];
    if (choice.Association < 0)
    {
      choice = { list->GetFieldAssociation(i), name };
    }
  }
  const auto found = std::find_if(
    first.begin(), first.end(), [](const Choice& choice) { return choice.Association >= 0; });
  return found == first.end() ? Choice() : *found;
}

// The name in a property of five elements; empty without one.
std::string nameIn(vtkSMProperty* property, bool isUnchecked)
{
  if (!property)
  {
    return "";
  }
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(isUnchecked);
  return helper.GetNumberOfElements() == elements ? helper.GetAsString(nameElement) : "";
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
  const bool isNewInput = chosen.GetAsProxy() != given.GetAsProxy();
  const bool isRenamed =
    requestingProperty && requestingProperty == this->GetRequiredProperty("Namesake");
  for (const bool isUnchecked : { false, true })
  {
    const std::string name = nameIn(property, isUnchecked);
    unsigned int place = 0;
    const bool isMissing = !name.empty() && !this->IsInDomain(name.c_str(), place);
    // pvpython makes a filter on the active source first, whatever its Input will be.
    const bool isFirst = !name.empty() && name == this->FirstChoice;
    if ((name.empty() && this->IsWaiting) || (isUnchecked && isNewInput && isMissing) ||
      (isFirst && (isRenamed || (requestingProperty == input && isMissing))))
    {
      this->SetDefaultValues(property, isUnchecked);
    }
  }
}

int vtkSMDensityArrayDomain::SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues)
{
  vtkPVDataInformation* data = this->GetInputDataInformation("Input");
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(useUncheckedValues);
  const bool hasRun = this->IsWaiting;
  this->IsWaiting = this->GetNumberOfStrings() == 0;
  if (!data || this->IsWaiting || helper.GetNumberOfElements() != elements)
  {
    return 0;
  }
  const Choice choice =
    choose(this, data, nameIn(this->GetRequiredProperty("Namesake"), useUncheckedValues), hasRun);
  this->FirstChoice = choice.Name;
  if (choice.Association >= 0)
  {
    helper.Set(nameElement - 1, std::to_string(choice.Association).c_str());
  }
  helper.Set(nameElement, choice.Name.c_str()); // none where all are ids, flags or text
  return 1;
}

bool vtkSMDensityArrayDomain::IsFilteredArray(vtkPVDataInformation*, int, const char* name)
{
  return name && std::string(name) == vtkDataSetAttributes::GhostArrayName();
}
