// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkSMTransportStateProxy.h"

#include "Display/ClassByName.h"

#include "vtkObjectFactory.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"

#include <sstream>
#include <string>

vtkStandardNewMacro(vtkSMTransportStateProxy);

namespace
{

bool hasProperty(vtkPVXMLElement* element, const std::string& name)
{
  for (unsigned int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* nested = element->GetNestedElement(i);
    const char* found = nested->GetAttribute("name");
    if (std::string(nested->GetName()) == "Property" && found && found == name)
    {
      return true;
    }
  }
  return false;
}

// Whether a state was written before the filter had the property. States have all properties, but
// for those of an undone change.
bool isFromBefore(vtkPVXMLElement* state, vtkPVXMLElement* hint)
{
  std::istringstream written(hint->GetAttributeOrEmpty("written"));
  std::string name;
  while (written >> name)
  {
    if (!hasProperty(state, name))
    {
      return false;
    }
  }
  return !hasProperty(state, hint->GetAttributeOrEmpty("name"));
}

} // namespace

int vtkSMTransportStateProxy::LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator)
{
  const int isLoaded = this->Superclass::LoadXMLState(element, locator);
  vtkPVXMLElement* hints = this->GetHints();
  for (unsigned int i = 0; isLoaded && hints && i < hints->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* hint = hints->GetNestedElement(i);
    int value = 0;
    if (std::string(hint->GetName()) == "WithoutProperty" &&
      hint->GetScalarAttribute("value", &value) && isFromBefore(element, hint))
    {
      vtkSMPropertyHelper(this, hint->GetAttribute("name")).Set(value);
    }
  }
  return isLoaded;
}

namespace
{

const bool isRegistered =
  RectifiedTransport::registerClass<vtkSMTransportStateProxy>("vtkSMTransportStateProxy");

} // namespace
