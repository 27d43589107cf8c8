// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMTransportStateProxy
 * @brief   a filter that old state files give what they gave
 *
 * The XML element TransportStateProxy. ParaView gives properties that a state file lacks their
 * defaults. Where what there was before a property is not its default, hints of the filter say so:
 *
 *   <WithoutProperty name="EmptyCells" value="0" written="Blend DensityArray"/>
 *
 * A state that has the properties `written` and lacks `name`, of integers, was written before it.
 */
#ifndef vtkSMTransportStateProxy_h
#define vtkSMTransportStateProxy_h

#include "vtkSMSourceProxy.h"

class vtkSMTransportStateProxy : public vtkSMSourceProxy
{
public:
  static vtkSMTransportStateProxy* New();
  vtkTypeMacro(vtkSMTransportStateProxy, vtkSMSourceProxy);

  int LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator) override;

protected:
  vtkSMTransportStateProxy() = default;
  ~vtkSMTransportStateProxy() override = default;

private:
  vtkSMTransportStateProxy(const vtkSMTransportStateProxy&) = delete;
  void operator=(const vtkSMTransportStateProxy&) = delete;
};

#endif
