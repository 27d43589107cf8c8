// SPDX-License-Identifier: BSD-3-Clause
#include "Display/FirstDisplay.h"

#include "Display/DotDisplay.h"
#include "Display/ProxyTexts.h"
#include "Display/ScatterDisplay.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr const char* elementName = "FirstDisplay";
constexpr const char* qualitativeColours = "Brewer Qualitative Set3";

bool isGiven(vtkPVXMLElement* element, const char* attribute, int& value)
{
  return element->GetScalarAttribute(attribute, &value) != 0;
}

// The value of a number; of an input whether it is given.
int valueOf(vtkSMProxy* producer, const char* property)
{
  vtkSMPropertyHelper helper(producer, property);
  return vtkSMProxyProperty::SafeDownCast(producer->GetProperty(property))
    ? helper.GetNumberOfElements() > 0 && helper.GetAsProxy() != nullptr
    : helper.GetAsInt();
}

// A hint may ask for a value of a property of the producer, or for a dimension of its data; the
// first one that applies is taken.
bool applies(vtkPVXMLElement* element, vtkSMSourceProxy* producer, int port)
{
  int value = 0;
  const char* property = element->GetAttribute("property");
  if (property && isGiven(element, "value", value) && valueOf(producer, property) != value)
  {
    return false;
  }
  return !isGiven(element, "dimension", value) ||
    dimensionOf(producer->GetDataInformation(static_cast<unsigned int>(port))->GetBounds()) ==
    value;
}

vtkPVXMLElement* elementFor(vtkSMSourceProxy* producer, int port)
{
  for (vtkPVXMLElement* element : hintElements(producer, elementName, port))
  {
    if (applies(element, producer, port))
    {
      return element;
    }
  }
  return nullptr;
}

bool followsProperties(vtkSMSourceProxy* producer, int port)
{
  const std::vector<vtkPVXMLElement*> elements = hintElements(producer, elementName, port);
  return std::any_of(elements.begin(), elements.end(),
    [](vtkPVXMLElement* element) { return element->GetAttribute("property") != nullptr; });
}

// A colour for each whole number from 0 to the highest, which a table of few colours repeats.
void colourByCategories(vtkSMProxy* representation, int highest)
{
  vtkSMProxy* table = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  if (!table)
  {
    return;
  }
  vtkSMPropertyHelper(table, "IndexedLookup").Set(1);
  vtkSMPropertyHelper annotations(table, "Annotations");
  annotations.SetNumberOfElements(static_cast<unsigned int>(2 * (highest + 1)));
  for (int i = 0; i <= highest; ++i)
  {
    const std::string text = std::to_string(i);
    annotations.Set(static_cast<unsigned int>(2 * i), text.c_str());
    annotations.Set(static_cast<unsigned int>(2 * i + 1), text.c_str());
  }
  vtkSMTransferFunctionProxy::ApplyPreset(table, qualitativeColours, false);
  table->UpdateVTKObjects();
}

// Colours by logarithms if the values are positive and span more than the factor `least`. Call it
// before the colours get their range.
void colourByLogarithms(vtkSMProxy* representation, double least, const double* range)
{
  vtkSMProxy* table = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  if (!table || !(range[0] > 0.0) || !(range[1] > least * range[0]))
  {
    return;
  }
  vtkSMTransferFunctionProxy::RescaleTransferFunction(table, range[0], range[1]);
  vtkSMTransferFunctionProxy::MapControlPointsToLogSpace(table);
  vtkSMPropertyHelper(table, "UseLogScale").Set(1);
  table->UpdateVTKObjects();
}

void colourBy(
  vtkPVXMLElement* element, vtkPVDataInformation* data, vtkSMPVRepresentationProxy* representation)
{
  const char* array = element->GetAttribute("array");
  if (!array)
  {
    return;
  }
  if (!*array)
  {
    representation->SetScalarColoring(nullptr, vtkDataObject::POINT);
    return;
  }
  for (int association : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    if (vtkPVArrayInformation* information = data->GetArrayInformation(array, association))
    {
      representation->SetScalarColoring(array, association);
      int categories = 0;
      double least = 0.0;
      if (element->GetScalarAttribute("log", &least))
      {
        colourByLogarithms(representation, least, information->GetComponentRange(0));
      }
      if (isGiven(element, "categories", categories) && categories != 0)
      {
        colourByCategories(representation, static_cast<int>(information->GetComponentRange(0)[1]));
      }
      else
      {
        representation->RescaleTransferFunctionToDataRange();
      }
      return;
    }
  }
}

void setProperty(vtkSMProxy* proxy, const char* name, const char* text)
{
  if (!name || !text || !proxy->GetProperty(name))
  {
    return;
  }
  std::istringstream words(text);
  std::vector<double> values;
  for (double value = 0.0; words >> value;)
  {
    values.push_back(value);
  }
  vtkSMPropertyHelper(proxy, name).Set(values.data(), static_cast<unsigned int>(values.size()));
}

bool showsDots(vtkPVXMLElement* element)
{
  const char* type = element ? element->GetAttribute("type") : nullptr;
  return type && std::string(type) == "Dots";
}

void apply(vtkPVXMLElement* element, vtkSMSourceProxy* producer, int port, vtkSMViewProxy* view,
  vtkSMPVRepresentationProxy* representation)
{
  if (showsDots(element))
  {
    showDots(producer, port, view, representation);
  }
  else if (const char* type = element->GetAttribute("type"))
  {
    representation->SetRepresentationType(type);
  }
  colourBy(element, producer->GetDataInformation(static_cast<unsigned int>(port)), representation);
  for (unsigned int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* set = element->GetNestedElement(i);
    setProperty(representation, set->GetAttribute("property"), set->GetAttribute("values"));
  }
  representation->UpdateVTKObjects();
}

bool isBehindDots(vtkSMProxy* consumer, vtkSMViewProxy* view)
{
  for (unsigned int i = 0; i < consumer->GetNumberOfProducers(); ++i)
  {
    vtkSMProxy* proxy = consumer->GetProducerProxy(i);
    auto* source = proxy ? vtkSMSourceProxy::SafeDownCast(proxy->GetTrueParentProxy()) : nullptr;
    for (unsigned int port = 0; source && port < source->GetNumberOfOutputPorts(); ++port)
    {
      vtkSMProxy* shown = view->FindRepresentation(source, port);
      if (shown && textOf(shown, "Representation") == typeOfDots)
      {
        return true;
      }
    }
    if (source && isBehindDots(source, view))
    {
      return true;
    }
  }
  return false;
}

// What comes of particles by other filters and from files would be dots of a pixel.
bool areParticles(vtkSMSourceProxy* producer, int port, vtkSMViewProxy* view)
{
  vtkPVDataInformation* data = producer->GetDataInformation(static_cast<unsigned int>(port));
  const vtkTypeInt64 cells = data->GetNumberOfCells();
  return !data->IsCompositeDataSet() && data->DataSetTypeIsA("vtkPointSet") &&
    (cells == 0 || cells == data->GetNumberOfPoints()) && data->GetNumberOfPoints() > 0 &&
    (data->GetArrayInformation("SeedId", vtkDataObject::POINT) || isBehindDots(producer, view));
}

// Follows the producer's properties, which say what the next data will be. Colours take their range
// from these data once they are there; a type cannot be changed while the view updates.
class Follower : public vtkCommand
{
public:
  vtkTypeMacro(Follower, vtkCommand);

  static Follower* New() { return new Follower; }

  void Follow(vtkSMSourceProxy* producer, int port, vtkSMPVRepresentationProxy* representation)
  {
    this->Port = port;
    this->Representation = representation;
    this->Remember(elementFor(producer, port));
    this->HasDots = showsDots(this->Applied);
    producer->AddObserver(vtkCommand::UpdateEvent, this);
    producer->AddObserver(vtkCommand::UpdateDataEvent, this);
  }

  void Execute(vtkObject* caller, unsigned long event, void*) override
  {
    auto* producer = vtkSMSourceProxy::SafeDownCast(caller);
    if (!producer || !this->Representation)
    {
      return;
    }
    if (event == vtkCommand::UpdateDataEvent)
    {
      if (std::exchange(this->IsColoured, false))
      {
        this->Representation->RescaleTransferFunctionToDataRange();
        vtkSMTransferFunctionProxy::UpdateScalarBarsComponentTitle(
          vtkSMPropertyHelper(this->Representation, "LookupTable").GetAsProxy(),
          this->Representation->GetArrayInformationForColorArray());
      }
      if (showsDots(this->Applied) && !std::exchange(this->HasDots, true))
      {
        vtkSMViewProxy* view = vtkSMViewProxy::FindView(this->Representation);
        showDots(producer, this->Port, view, this->Representation);
      }
      return;
    }
    vtkPVXMLElement* element = elementFor(producer, this->Port);
    if (element && element != this->Applied &&
      textOf(this->Representation, "Representation") == this->Type)
    {
      this->Change(element);
      this->Remember(element);
    }
  }

private:
  // Hides the scalar bar of the old array with its table, and shows one for the new array if there
  // was one.
  void Change(vtkPVXMLElement* element)
  {
    if (const char* type = element->GetAttribute("type"))
    {
      this->Representation->SetRepresentationType(showsDots(element) ? typeOfDots : type);
    }
    const char* array = element->GetAttribute("array");
    this->IsColoured = array != nullptr;
    if (array || this->Applied->GetAttribute("array"))
    {
      vtkSMViewProxy* view = vtkSMViewProxy::FindView(this->Representation);
      const bool hasBar = this->Representation->IsScalarBarVisible(view);
      vtkSmartPointer<vtkSMProxy> table =
        vtkSMPropertyHelper(this->Representation, "LookupTable").GetAsProxy();
      const int association =
        vtkSMPropertyHelper(this->Representation, "ColorArrayName").GetInputArrayAssociation();
      this->Representation->SetScalarColoring(array, association);
      if (hasBar)
      {
        vtkNew<vtkSMTransferFunctionManager> manager;
        manager->HideScalarBarIfNotNeeded(table, view);
        this->Representation->SetScalarBarVisibility(view, this->IsColoured);
      }
    }
    this->Representation->UpdateVTKObjects();
  }

  void Remember(vtkPVXMLElement* element)
  {
    this->Applied = element;
    this->Type = textOf(this->Representation, "Representation");
  }

  int Port = 0;
  bool IsColoured = false; // by an array whose range is not known yet
  bool HasDots = false;    // set up, once there were data
  vtkWeakPointer<vtkSMPVRepresentationProxy> Representation;
  vtkPVXMLElement* Applied = nullptr; // an element of the proxy's definition, which stays
  std::string Type;
};

} // namespace

void applyFirstDisplay(
  vtkSMSourceProxy* producer, int port, vtkSMViewProxy* view, vtkSMProxy* proxy)
{
  auto* representation = vtkSMPVRepresentationProxy::SafeDownCast(proxy);
  if (!representation)
  {
    // The view is no render view.
    if (vtkPVXMLElement* element = elementFor(producer, port))
    {
      showScatter(element, producer, port, view, proxy);
    }
    return;
  }
  if (vtkPVXMLElement* element = elementFor(producer, port))
  {
    apply(element, producer, port, view, representation);
  }
  else if (hintElements(producer, elementName).empty() && areParticles(producer, port, view))
  {
    showDots(producer, port, view, representation);
  }
  if (followsProperties(producer, port))
  {
    vtkNew<Follower> follower;
    follower->Follow(producer, port, representation);
  }
}

} // namespace RectifiedTransport
