// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMDeviceNameDomain
 * @brief   the names that the panel offers for a device
 *
 * In XML the element DeviceNameDomain: the strings of the required property and, if it is not among
 * them, the property's own value. A name from a state of another machine, or a part of a name,
 * would otherwise be lost as soon as the panel shows the list.
 */
#ifndef vtkSMDeviceNameDomain_h
#define vtkSMDeviceNameDomain_h

#include "vtkSMStringListDomain.h"

class vtkSMDeviceNameDomain : public vtkSMStringListDomain
{
public:
  static vtkSMDeviceNameDomain* New();
  vtkTypeMacro(vtkSMDeviceNameDomain, vtkSMStringListDomain);

protected:
  vtkSMDeviceNameDomain() = default;
  ~vtkSMDeviceNameDomain() override = default;

  void SetStrings(const std::vector<std::string>& strings) override;

private:
  vtkSMDeviceNameDomain(const vtkSMDeviceNameDomain&) = delete;
  void operator=(const vtkSMDeviceNameDomain&) = delete;
};

#endif
