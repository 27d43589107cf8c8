// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkSMVectorWriterInitializationHelper.h"

#include "Display/DotDisplay.h"
#include "Display/ProxyTexts.h"

#include "vtkObjectFactory.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

vtkStandardNewMacro(vtkSMVectorWriterInitializationHelper);

namespace
{

using RectifiedTransport::textOf;

// In the active view, where it is visible; else nullptr.
vtkSMPVRepresentationProxy* representationOf(vtkSMProxy* writer)
{
  vtkSMPropertyHelper input(writer, "Input", true);
  vtkSMProxySelectionModel* active =
    writer->GetSessionProxyManager()->GetSelectionModel("ActiveView");
  auto* view = active ? vtkSMViewProxy::SafeDownCast(active->GetCurrentProxy()) : nullptr;
  auto* producer = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  if (!view || !producer)
  {
    return nullptr;
  }
  auto* found = vtkSMPVRepresentationProxy::SafeDownCast(
    view->FindRepresentation(producer, static_cast<int>(input.GetOutputPort())));
  return found && vtkSMPropertyHelper(found, "Visibility", true).GetAsInt() ? found : nullptr;
}

bool showsPlainCircles(vtkSMProxy* representation)
{
  return textOf(representation, "Representation") == RectifiedTransport::typeOfDots &&
    textOf(representation, "ShaderPreset") == "Plain circle" &&
    !vtkSMPropertyHelper(representation, "ScaleByArray", true).GetAsInt();
}

} // namespace

void vtkSMVectorWriterInitializationHelper::PostInitializeProxy(
  vtkSMProxy* writer, vtkPVXMLElement*, vtkMTimeType time)
{
  vtkSMPVRepresentationProxy* shown = representationOf(writer);
  const auto isFree = [writer, time](const char* name) {
    vtkSMProperty* property = writer->GetProperty(name);
    return property && property->GetMTime() <= time;
  };
  if (shown && isFree("ColorArray") && isFree("LookupTable") && shown->GetUsingScalarColoring())
  {
    vtkSMPropertyHelper colours(shown, "ColorArrayName");
    vtkSMPropertyHelper(writer, "ColorArray")
      .SetInputArrayToProcess(
        colours.GetInputArrayAssociation(), colours.GetInputArrayNameToProcess());
    vtkSMPropertyHelper(writer, "LookupTable")
      .Set(vtkSMPropertyHelper(shown, "LookupTable").GetAsProxy());
  }
  if (shown && isFree("PointRadius") && showsPlainCircles(shown))
  {
    vtkSMPropertyHelper(writer, "PointRadius")
      .Set(vtkSMPropertyHelper(shown, "GaussianRadius").GetAsDouble());
  }
  if (shown && isFree("FillOutlines") &&
    textOf(shown, "Representation").rfind("Filled Outlines", 0) == 0)
  {
    vtkSMPropertyHelper(writer, "FillOutlines").Set(1);
  }
}
