// SPDX-License-Identifier: BSD-3-Clause
// The plugin's own elements among the hints of a proxy, and texts of its properties.
#ifndef RectifiedTransport_ProxyTexts_h
#define RectifiedTransport_ProxyTexts_h

#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <algorithm>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// Those of a name in their order.
inline std::vector<vtkPVXMLElement*> hintElements(vtkSMProxy* proxy, const std::string& name)
{
  std::vector<vtkPVXMLElement*> found;
  vtkPVXMLElement* hints = proxy->GetHints();
  for (unsigned int i = 0; hints && i < hints->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* element = hints->GetNestedElement(i);
    if (element->GetName() && name == element->GetName())
    {
      found.push_back(element);
    }
  }
  return found;
}

// Those of an output port; an element without the attribute is of all ports.
inline std::vector<vtkPVXMLElement*> hintElements(
  vtkSMProxy* proxy, const std::string& name, int port)
{
  std::vector<vtkPVXMLElement*> found = hintElements(proxy, name);
  const auto isOfOther = [port](vtkPVXMLElement* element) {
    int value = port;
    return element->GetScalarAttribute("port", &value) && value != port;
  };
  found.erase(std::remove_if(found.begin(), found.end(), isOfOther), found.end());
  return found;
}

// Whether it stands in the plugin's menu.
inline bool isOfPlugin(vtkSMProxy* proxy)
{
  const std::vector<vtkPVXMLElement*> menus = hintElements(proxy, "ShowInMenu");
  return !menus.empty() && std::string(menus[0]->GetAttributeOrEmpty("category")) == "Transport";
}

// The value of a property; empty without one.
inline std::string textOf(vtkSMProxy* proxy, const char* property)
{
  const char* text = vtkSMPropertyHelper(proxy, property, true).GetAsString();
  return text ? text : "";
}

} // namespace RectifiedTransport

#endif
