// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMTransportStateProxy
 * @brief   a filter that old state files give what they gave
 *
 * The XML element TransportStateProxy. ParaView gives properties that a state file lacks their
 * defaults, and ignores those that the filter does not have any more. Hints of the filter say what
 * an older state means:
 *
 *   <WithoutProperty name="EmptyCells" value="0" written="Blend DensityArray"/>
 *   <RenamedProperty from="Chain" name="TrackParticles"/>
 *   <RenumberedProperty name="Method" values="1 0" written="Chain"/>
 *
 * WithoutProperty: a state that has the properties `written` and lacks `name`, an integer or a
 * text, was written before there was `name`, and gets `value`. RenamedProperty: `from` is what
 * `name` was called. RenumberedProperty: in a state that has the properties `written`, value i of
 * the enumeration `name` is the i-th of `values` now.
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
