// SPDX-License-Identifier: BSD-3-Clause
#include "Display/DotDisplay.h"
#include "Display/ProxyTexts.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSettingsProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <array>
#include <string>

namespace RectifiedTransport
{

int dimensionOf(const double bounds[6])
{
  int dimension = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    dimension += bounds[2 * axis] < bounds[2 * axis + 1] ? 1 : 0;
  }
  return dimension;
}

namespace
{

using Rgb = std::array<double, 3>;

constexpr Rgb black = { 0.0, 0.0, 0.0 };
constexpr Rgb white = { 1.0, 1.0, 1.0 };

Rgb colourOf(vtkSMProxy* proxy, const char* property)
{
  Rgb colour = black;
  vtkSMPropertyHelper(proxy, property, true).Get(colour.data(), 3);
  return colour;
}

constexpr std::array<const char*, 2> colourProperties = { "AmbientColor", "DiffuseColor" };

vtkSMProxy* paletteOf(vtkSMProxy* proxy)
{
  return proxy->GetSessionProxyManager()->GetProxy("settings", "ColorPalette");
}

// ParaView links colours to the palette's, which are white. A state that has the links is opened
// with these colours instead of its own.
void unlinkColours(vtkSMProxy* representation)
{
  auto* palette = vtkSMSettingsProxy::SafeDownCast(paletteOf(representation));
  for (const char* property : colourProperties)
  {
    const char* source =
      palette ? palette->GetSourcePropertyName(representation, property) : nullptr;
    if (source)
    {
      palette->RemoveLink(std::string(source).c_str(), representation, property);
    }
  }
}

// Black or white, whichever the background is less.
Rgb colourOn(vtkSMProxy* view)
{
  vtkSMProxy* palette = paletteOf(view);
  const bool isOfPalette =
    palette && vtkSMPropertyHelper(view, "UseColorPaletteForBackground", true).GetAsInt() != 0;
  const Rgb background =
    isOfPalette ? colourOf(palette, "BackgroundColor") : colourOf(view, "Background");
  // Luminance of Rec. 709.
  return 0.2126 * background[0] + 0.7152 * background[1] + 0.0722 * background[2] > 0.5 ? black
                                                                                        : white;
}

// On the server, where the data are; 0 where there is none.
double radiusOf(vtkSMSourceProxy* producer, int port)
{
  const auto proxy = vtkSmartPointer<vtkSMProxy>::Take(
    producer->GetSessionProxyManager()->NewProxy("internal_filters", "TransportDotRadius"));
  auto* measure = vtkSMSourceProxy::SafeDownCast(proxy);
  if (!measure)
  {
    return 0.0;
  }
  vtkSMPropertyHelper(measure, "Input").Set(producer, static_cast<unsigned int>(port));
  measure->UpdateVTKObjects();
  measure->UpdatePipeline();
  vtkPVArrayInformation* radius =
    measure->GetDataInformation(0)->GetArrayInformation("DotRadius", vtkDataObject::ROW);
  return radius ? radius->GetComponentRange(0)[0] : 0.0;
}

class DotFollower : public vtkCommand
{
public:
  vtkTypeMacro(DotFollower, vtkCommand);

  static DotFollower* New() { return new DotFollower; }

  void Follow(vtkSMSourceProxy* producer, int port, vtkSMViewProxy* view,
    vtkSMPVRepresentationProxy* representation)
  {
    this->Port = port;
    this->Producer = producer;
    this->Representation = representation;
    this->View = view;
    this->IsFlat = dimensionOf(this->Data()->GetBounds()) < 3;
    vtkSMPropertyHelper(representation, "ShaderPreset")
      .Set(this->IsFlat ? "Plain circle" : "Sphere");
    this->UseRadius();
    producer->AddObserver(vtkCommand::UpdateDataEvent, this);
    const char* colours =
      vtkSMPropertyHelper(representation, "ColorArrayName").GetInputArrayNameToProcess();
    if (colours && std::string(colours) == "Mass") // which is the same for all
    {
      representation->SetScalarColoring(nullptr, vtkDataObject::POINT);
    }
    if (this->IsFlat && this->View)
    {
      representation->SetScalarColoring(nullptr, vtkDataObject::POINT);
      unlinkColours(representation);
      this->UseColour();
      this->View->AddObserver(vtkCommand::PropertyModifiedEvent, this);
      if (vtkSMProxy* palette = paletteOf(this->View))
      {
        palette->AddObserver(vtkCommand::PropertyModifiedEvent, this);
      }
    }
    representation->UpdateVTKObjects();
  }

  void Execute(vtkObject*, unsigned long event, void* data) override
  {
    if (!this->Representation || !this->Producer || !this->View)
    {
      return;
    }
    if (event == vtkCommand::UpdateDataEvent)
    {
      this->FollowData();
    }
    else if (data &&
      std::string(static_cast<const char*>(data)).find("Background") != std::string::npos)
    {
      this->FollowBackground();
    }
  }

private:
  vtkPVDataInformation* Data()
  {
    return this->Producer->GetDataInformation(static_cast<unsigned int>(this->Port));
  }

  void FollowData()
  {
    vtkSMPropertyHelper radius(this->Representation, "GaussianRadius");
    if (textOf(this->Representation, "Representation") == typeOfDots &&
      radius.GetAsDouble() == this->Radius)
    {
      this->UseRadius();
      this->Representation->UpdateVTKObjects();
    }
  }

  void FollowBackground()
  {
    if (colourOf(this->Representation, "DiffuseColor") == this->Colour)
    {
      this->UseColour();
      this->Representation->UpdateVTKObjects();
    }
  }

  void UseRadius()
  {
    const bool isEmpty = this->Data()->GetNumberOfPoints() == 0;
    const double radius = isEmpty ? 0.0 : radiusOf(this->Producer, this->Port);
    // A view of a single place is 1 wide.
    this->Radius = radius > 0.0 ? radius : 0.05;
    vtkSMPropertyHelper(this->Representation, "GaussianRadius").Set(this->Radius);
  }

  void UseColour()
  {
    this->Colour = colourOn(this->View);
    for (const char* property : colourProperties)
    {
      vtkSMPropertyHelper(this->Representation, property).Set(this->Colour.data(), 3);
    }
  }

  int Port = 0;
  bool IsFlat = false;
  vtkWeakPointer<vtkSMSourceProxy> Producer;
  vtkWeakPointer<vtkSMPVRepresentationProxy> Representation;
  vtkWeakPointer<vtkSMViewProxy> View;
  // What was set here; if the values are others, they are the user's.
  double Radius = 0.0;
  Rgb Colour = black;
};

} // namespace

void showDots(vtkSMSourceProxy* producer, int port, vtkSMViewProxy* view,
  vtkSMPVRepresentationProxy* representation)
{
  representation->SetRepresentationType(typeOfDots);
  vtkNew<DotFollower> follower;
  follower->Follow(producer, port, view, representation);
}

} // namespace RectifiedTransport
