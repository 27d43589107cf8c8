// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkSMTransportWarpProxy.h"

#include "Display/ClassByName.h"

#include "vtkObjectFactory.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"

#include <string>

vtkStandardNewMacro(vtkSMTransportWarpProxy);

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

} // namespace

int vtkSMTransportWarpProxy::LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator)
{
  const int isLoaded = this->Superclass::LoadXMLState(element, locator);
  // States have all properties, but for those of an undone change.
  if (isLoaded && hasProperty(element, "Blend") && hasProperty(element, "DensityArray") &&
    !hasProperty(element, "EmptyCells"))
  {
    vtkSMPropertyHelper(this, "EmptyCells").Set(0);
  }
  return isLoaded;
}

namespace
{

const bool isRegistered =
  RectifiedTransport::registerClass<vtkSMTransportWarpProxy>("vtkSMTransportWarpProxy");

} // namespace
