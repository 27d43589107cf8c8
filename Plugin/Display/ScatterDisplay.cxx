// SPDX-License-Identifier: BSD-3-Clause
#include "Display/ScatterDisplay.h"

#include "Display/ProxyTexts.h"

#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr const char* circle = "4"; // a value of SeriesMarkerStyle
constexpr const char* size = "9";   // pixels, a value of SeriesMarkerSize

void setTexts(vtkSMProxy* proxy, const char* name, const std::vector<std::string>& texts)
{
  if (!proxy->GetProperty(name))
  {
    return;
  }
  vtkSMPropertyHelper property(proxy, name);
  property.SetNumberOfElements(static_cast<unsigned int>(texts.size()));
  for (unsigned int i = 0; i < texts.size(); ++i)
  {
    property.Set(i, texts[i].c_str());
  }
}

} // namespace

bool hasScatter(vtkSMProxy* producer, int port)
{
  const std::vector<vtkPVXMLElement*> found = hintElements(producer, "FirstDisplay", port);
  return !found.empty() && std::string(found[0]->GetAttributeOrEmpty("type")) == "Scatter";
}

void showScatter(vtkPVXMLElement* element, vtkSMSourceProxy* producer, int port,
  vtkSMViewProxy* view, vtkSMProxy* representation)
{
  const char* x = element->GetAttribute("x");
  const char* y = element->GetAttribute("y");
  vtkPVDataSetAttributesInformation* columns =
    producer->GetDataInformation(static_cast<unsigned int>(port))
      ->GetAttributeInformation(vtkDataObject::ROW);
  if (!x || !y || !representation->GetProperty("XArrayName") || !columns->GetArrayInformation(x) ||
    !columns->GetArrayInformation(y))
  {
    return;
  }
  std::vector<std::string> visibility;
  for (int i = 0; i < columns->GetNumberOfArrays(); ++i)
  {
    const std::string name = columns->GetArrayInformation(i)->GetName();
    visibility.insert(visibility.end(), { name, name == y ? "1" : "0" });
  }
  vtkSMPropertyHelper(representation, "UseIndexForXAxis").Set(0);
  vtkSMPropertyHelper(representation, "XArrayName").Set(x);
  setTexts(representation, "SeriesVisibility", visibility);
  setTexts(representation, "SeriesMarkerStyle", { y, circle });
  setTexts(representation, "SeriesMarkerSize", { y, size });
  representation->UpdateVTKObjects();
  setTexts(view, "BottomAxisTitle", { x });
  setTexts(view, "LeftAxisTitle", { y });
  vtkSMPropertyHelper(view, "ShowLegend", true).Set(0);
  view->UpdateVTKObjects();
}

} // namespace RectifiedTransport
