// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportDisplayController
 * @brief   ParaView's controller, which sets up how a filter's output is shown and contoured at
 * first
 *
 * ParaView's own hints support one type of representation for an output, whatever the data, and
 * colour only by the active scalars. This class replaces ParaView's controller in the client's
 * object factory. It shows an output as that one does, then follows the FirstDisplay elements in
 * the hints of the filter's proxy. It initialises a Contour as that one does, then follows the
 * FirstContour elements. Proxies without them are treated as before. A filter of particles begins
 * with what these say of their density. A trace loads the plugin before the first of its filters.
 * When a morph is deleted, the times of what it was made of come back.
 *
 * @sa vtkSMParaViewPipelineControllerWithRendering
 */
#ifndef vtkTransportDisplayController_h
#define vtkTransportDisplayController_h

#include "vtkSMParaViewPipelineControllerWithRendering.h"

class vtkTransportDisplayController : public vtkSMParaViewPipelineControllerWithRendering
{
public:
  static vtkTransportDisplayController* New();

  // No vtkTypeMacro: Python looks the class up by its name, and knows the superclass only.
  using Superclass = vtkSMParaViewPipelineControllerWithRendering;
  using Superclass::Show;
  vtkSMProxy* Show(vtkSMSourceProxy* producer, int outputPort, vtkSMViewProxy* view,
    const char* representationType) override;
  // A chart of points without names gets a table beside it, which has them.
  vtkSMViewProxy* ShowInPreferredView(
    vtkSMSourceProxy* producer, int outputPort, vtkSMViewProxy* view) override;
  const char* GetPreferredViewType(vtkSMSourceProxy* producer, int outputPort) override;
  bool RegisterRepresentationProxy(vtkSMProxy* proxy) override;
  bool PreInitializeProxy(vtkSMProxy* proxy) override;
  bool PostInitializeProxy(vtkSMProxy* proxy) override;

  using Superclass::UnRegisterProxy;
  bool UnRegisterProxy(vtkSMProxy* proxy) override;

protected:
  vtkTransportDisplayController() = default;
  ~vtkTransportDisplayController() override = default;

private:
  // During Show, of an output that the view has not shown yet.
  vtkSMSourceProxy* ShownFirst = nullptr;
  int ShownPort = 0;
  vtkSMViewProxy* ShownIn = nullptr;

  bool IsForTable = false; // what is shown now

  vtkTransportDisplayController(const vtkTransportDisplayController&) = delete;
  void operator=(const vtkTransportDisplayController&) = delete;
};

#endif
