// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMTransportWarpProxy
 * @brief   a warp that old state files give what they gave
 *
 * The XML element TransportWarpProxy. A state file that was written before there was the property
 * EmptyCells means Zero, which is not the default: ParaView gives properties that a state lacks
 * their defaults.
 */
#ifndef vtkSMTransportWarpProxy_h
#define vtkSMTransportWarpProxy_h

#include "vtkSMSourceProxy.h"

class vtkSMTransportWarpProxy : public vtkSMSourceProxy
{
public:
  static vtkSMTransportWarpProxy* New();
  vtkTypeMacro(vtkSMTransportWarpProxy, vtkSMSourceProxy);

  int LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator) override;

protected:
  vtkSMTransportWarpProxy() = default;
  ~vtkSMTransportWarpProxy() override = default;

private:
  vtkSMTransportWarpProxy(const vtkSMTransportWarpProxy&) = delete;
  void operator=(const vtkSMTransportWarpProxy&) = delete;
};

#endif
