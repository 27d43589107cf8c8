// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkTransportDisplayController.h"

#include "Display/FirstContour.h"
#include "Display/FirstDisplay.h"
#include "Display/ParticleReading.h"
#include "Display/PluginTrace.h"
#include "Display/ScatterDisplay.h"
#include "Display/vtkSMTransportMorphProxy.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"
#include "vtkVersion.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkTransportDisplayController);

vtkSMProxy* vtkTransportDisplayController::Show(
  vtkSMSourceProxy* producer, int outputPort, vtkSMViewProxy* view, const char* representationType)
{
  // Without a view the superclass chooses one, and calls this function with it.
  const bool isFirst = producer && view && !view->FindRepresentation(producer, outputPort);
  this->ShownFirst = isFirst ? producer : nullptr;
  this->ShownPort = outputPort;
  this->ShownIn = view;
  vtkSMProxy* shown = Superclass::Show(producer, outputPort, view, representationType);
  this->ShownFirst = nullptr;
  return shown;
}

vtkSMViewProxy* vtkTransportDisplayController::ShowInPreferredView(
  vtkSMSourceProxy* producer, int outputPort, vtkSMViewProxy* view)
{
  vtkSMViewProxy* shown = Superclass::ShowInPreferredView(producer, outputPort, view);
  if (producer && shown && shown != view && RectifiedTransport::hasScatter(producer, outputPort))
  {
    this->IsForTable = true;
    this->AssignViewToLayout(shown);
    this->AssignViewToLayout(Superclass::ShowInPreferredView(producer, outputPort, shown));
    this->IsForTable = false;
    // A view that is made becomes the active one.
    producer->GetSessionProxyManager()
      ->GetSelectionModel("ActiveView")
      ->SetCurrentProxy(shown, vtkSMProxySelectionModel::CLEAR_AND_SELECT);
  }
  return shown;
}

const char* vtkTransportDisplayController::GetPreferredViewType(
  vtkSMSourceProxy* producer, int outputPort)
{
  return this->IsForTable ? "SpreadSheetView"
                          : Superclass::GetPreferredViewType(producer, outputPort);
}

// Within Show a trace writes what is set here, and no more after it.
bool vtkTransportDisplayController::RegisterRepresentationProxy(vtkSMProxy* proxy)
{
  const bool isRegistered = Superclass::RegisterRepresentationProxy(proxy);
  if (isRegistered && this->ShownFirst)
  {
    RectifiedTransport::applyFirstDisplay(this->ShownFirst, this->ShownPort, this->ShownIn, proxy);
  }
  return isRegistered;
}

bool vtkTransportDisplayController::UnRegisterProxy(vtkSMProxy* proxy)
{
  const vtkSmartPointer<vtkSMTransportMorphProxy> morph =
    vtkSMTransportMorphProxy::SafeDownCast(proxy);
  const bool isDone = Superclass::UnRegisterProxy(proxy);
  if (morph)
  {
    morph->RestoreTimes();
  }
  return isDone;
}

bool vtkTransportDisplayController::PreInitializeProxy(vtkSMProxy* proxy)
{
  RectifiedTransport::tracePlugin(proxy);
  return Superclass::PreInitializeProxy(proxy);
}

bool vtkTransportDisplayController::PostInitializeProxy(vtkSMProxy* proxy)
{
  const vtkMTimeType time = proxy ? this->GetInitializationTime(proxy) : 0;
  const bool isContour = proxy && RectifiedTransport::isUnsetContour(proxy, time);
  RectifiedTransport::takeDensityOfParticles(proxy);
  const std::vector<std::string> unset = RectifiedTransport::unsetReading(proxy, time);
  const bool isInitialized = Superclass::PostInitializeProxy(proxy);
  if (isContour && isInitialized)
  {
    RectifiedTransport::applyFirstContour(proxy);
  }
  if (isInitialized && !unset.empty())
  {
    RectifiedTransport::readAsParticles(proxy, unset);
  }
  return isInitialized;
}

namespace
{

VTK_CREATE_CREATE_FUNCTION(vtkTransportDisplayController);

class DisplayFactory : public vtkObjectFactory
{
public:
  static DisplayFactory* New();
  vtkTypeMacro(DisplayFactory, vtkObjectFactory);
  const char* GetVTKSourceVersion() override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() override
  {
    return "How Rectified Transport's outputs look at first, and their contours";
  }

protected:
  DisplayFactory()
  {
    this->RegisterOverride("vtkSMParaViewPipelineControllerWithRendering",
      "vtkTransportDisplayController", "sets up representations", 1,
      vtkObjectFactoryCreatevtkTransportDisplayController);
  }
};

vtkStandardNewMacro(DisplayFactory);

// When the plugin's library is loaded.
const bool isRegistered = []() {
  vtkNew<DisplayFactory> factory;
  vtkObjectFactory::RegisterFactory(factory);
  return true;
}();

} // namespace
