// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkSMTransportStateProxy.h"

#include "Display/ProxyTexts.h"

#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"

#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkSMTransportStateProxy);

namespace
{

// The element of a property, or null.
vtkPVXMLElement* findProperty(vtkPVXMLElement* state, const std::string& name)
{
  for (unsigned int i = 0; i < state->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* nested = state->GetNestedElement(i);
    const char* found = nested->GetAttribute("name");
    if (std::string(nested->GetName()) == "Property" && found && found == name)
    {
      return nested;
    }
  }
  return nullptr;
}

// Whether a state has all properties that a hint calls `written`.
bool hasWritten(vtkPVXMLElement* state, vtkPVXMLElement* hint)
{
  std::istringstream written(hint->GetAttributeOrEmpty("written"));
  std::string name;
  while (written >> name)
  {
    if (!findProperty(state, name))
    {
      return false;
    }
  }
  return true;
}

void loadWithoutProperty(vtkSMProxy* proxy, vtkPVXMLElement* state, vtkPVXMLElement* hint)
{
  const char* name = hint->GetAttributeOrEmpty("name");
  if (!hasWritten(state, hint) || findProperty(state, name))
  {
    return;
  }
  vtkSMPropertyHelper property(proxy, name);
  int value = 0;
  hint->GetScalarAttribute("value", &value) ? property.Set(value)
                                            : property.Set(hint->GetAttributeOrEmpty("value"));
}

// While it exists, properties of a state have the names of now.
class RenamedProperties
{
public:
  RenamedProperties(vtkPVXMLElement* state, vtkSMProxy* proxy)
  {
    for (vtkPVXMLElement* hint : RectifiedTransport::hintElements(proxy, "RenamedProperty"))
    {
      const std::string before = hint->GetAttributeOrEmpty("from");
      if (vtkPVXMLElement* property = findProperty(state, before))
      {
        property->SetAttribute("name", hint->GetAttributeOrEmpty("name"));
        this->Renamed.emplace_back(property, before);
      }
    }
  }
  ~RenamedProperties()
  {
    for (const auto& [property, before] : this->Renamed)
    {
      property->SetAttribute("name", before.c_str());
    }
  }
  RenamedProperties(const RenamedProperties&) = delete;
  void operator=(const RenamedProperties&) = delete;

private:
  std::vector<std::pair<vtkPVXMLElement*, std::string>> Renamed;
};

void loadRenumbered(vtkSMProxy* proxy, vtkPVXMLElement* state, vtkPVXMLElement* hint)
{
  const char* name = hint->GetAttributeOrEmpty("name");
  if (!hasWritten(state, hint) || !findProperty(state, name))
  {
    return;
  }
  std::istringstream values(hint->GetAttributeOrEmpty("values"));
  const std::vector<int> now{ std::istream_iterator<int>(values), {} };
  vtkSMPropertyHelper property(proxy, name);
  const int before = property.GetAsInt();
  if (before >= 0 && before < static_cast<int>(now.size()))
  {
    property.Set(now[before]);
  }
}

} // namespace

int vtkSMTransportStateProxy::LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator)
{
  int isLoaded = 0;
  {
    const RenamedProperties renamed(element, this);
    isLoaded = this->Superclass::LoadXMLState(element, locator);
  }
  if (isLoaded)
  {
    for (vtkPVXMLElement* hint : RectifiedTransport::hintElements(this, "WithoutProperty"))
    {
      loadWithoutProperty(this, element, hint);
    }
    for (vtkPVXMLElement* hint : RectifiedTransport::hintElements(this, "RenumberedProperty"))
    {
      loadRenumbered(this, element, hint);
    }
  }
  return isLoaded;
}
