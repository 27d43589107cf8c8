// SPDX-License-Identifier: BSD-3-Clause
// The plugin's own elements among the hints of a proxy.
#ifndef RectifiedTransport_HintElements_h
#define RectifiedTransport_HintElements_h

#include "vtkPVXMLElement.h"
#include "vtkSMProxy.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{

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

// Whether an element is of a port; without the attribute it is of all.
inline bool isOfPort(vtkPVXMLElement* element, int port)
{
  int value = port;
  element->GetScalarAttribute("port", &value);
  return value == port;
}

} // namespace RectifiedTransport

#endif
