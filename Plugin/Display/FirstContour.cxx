// SPDX-License-Identifier: BSD-3-Clause
#include "Display/FirstContour.h"

#include "Display/ProxyTexts.h"

#include "vtkDataSetAttributes.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr const char* isovalues = "ContourValues";

// The array that a property names, or the active scalars if it names none.
vtkPVArrayInformation* arrayOf(
  vtkSMSourceProxy* source, unsigned int port, vtkSMPropertyHelper& array)
{
  vtkPVDataInformation* data = source->GetDataInformation(port);
  const char* name = array.GetInputArrayNameToProcess();
  if (name && *name)
  {
    return data->GetArrayInformation(name, array.GetInputArrayAssociation());
  }
  vtkPVArrayInformation* ofPoints =
    data->GetPointDataInformation()->GetAttributeInformation(vtkDataSetAttributes::SCALARS);
  return ofPoints
    ? ofPoints
    : data->GetCellDataInformation()->GetAttributeInformation(vtkDataSetAttributes::SCALARS);
}

// The least of the largest values of an array of all inputs; none if an input has no such array of
// one component.
std::optional<double> leastMaximum(
  vtkSMProxy* filter, const std::string& inputs, const std::string& array)
{
  vtkSMPropertyHelper sources(filter, inputs.c_str());
  vtkSMPropertyHelper chosen(filter, array.c_str());
  std::optional<double> least;
  for (unsigned int i = 0; i < sources.GetNumberOfElements(); ++i)
  {
    auto* source = vtkSMSourceProxy::SafeDownCast(sources.GetAsProxy(i));
    vtkPVArrayInformation* found =
      source ? arrayOf(source, sources.GetOutputPort(i), chosen) : nullptr;
    if (!found || found->GetNumberOfComponents() != 1)
    {
      return {};
    }
    const double largest = found->GetComponentRange(0)[1];
    least = least ? std::min(*least, largest) : largest;
  }
  return least;
}

// Whether the output has the scale of the inputs' arrays.
bool keepsScale(vtkSMProxy* filter)
{
  const std::string mode = textOf(filter, "MassMode");
  return (mode == "Linear" || mode == "Geometric") &&
    vtkSMPropertyHelper(filter, "InvertDensity").GetAsInt() == 0;
}

// Half of the least maximum of the inputs: every input has larger values.
std::optional<double> halfOf(vtkSMProxy* filter, const std::string& names)
{
  if (!keepsScale(filter))
  {
    return {};
  }
  double least = std::numeric_limits<double>::infinity();
  std::istringstream words(names);
  for (std::string inputs, array; words >> inputs >> array;)
  {
    const std::optional<double> largest = leastMaximum(filter, inputs, array);
    if (!largest)
    {
      return {};
    }
    least = std::min(least, *largest);
  }
  return 0.5 * least;
}

std::optional<double> isovalueOf(vtkPVXMLElement* element, vtkSMProxy* filter)
{
  double value = 0.0;
  if (element->GetScalarAttribute("value", &value))
  {
    return value;
  }
  const char* names = element->GetAttribute("half_of");
  return names ? halfOf(filter, names) : std::nullopt;
}

} // namespace

bool isUnsetContour(vtkSMProxy* proxy, vtkMTimeType time)
{
  const char* name = proxy->GetXMLName();
  vtkSMProperty* property = proxy->GetProperty(isovalues);
  return name && std::string(name) == "Contour" && property && property->GetMTime() <= time;
}

void applyFirstContour(vtkSMProxy* contour)
{
  vtkSMPropertyHelper input(contour, "Input");
  auto* filter = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  const unsigned int port = filter ? input.GetOutputPort() : 0;
  const std::vector<vtkPVXMLElement*> elements = filter
    ? hintElements(filter, "FirstContour", static_cast<int>(port))
    : std::vector<vtkPVXMLElement*>();
  vtkSMPropertyHelper contoured(contour, "SelectInputScalars");
  const char* name = contoured.GetInputArrayNameToProcess();
  if (!name || elements.empty() ||
    std::string(name) != elements[0]->GetAttributeOrDefault("array", name))
  {
    return;
  }
  vtkPVArrayInformation* array = arrayOf(filter, port, contoured);
  const std::optional<double> value = isovalueOf(elements[0], filter);
  if (array && value && array->GetComponentRange(0)[0] < *value &&
    *value < array->GetComponentRange(0)[1])
  {
    vtkSMPropertyHelper(contour, isovalues).Set(*value);
    contour->UpdateVTKObjects();
  }
}

} // namespace RectifiedTransport
