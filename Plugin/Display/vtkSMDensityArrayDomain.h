// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMDensityArrayDomain
 * @brief   which array of an input is its density at first
 *
 * A domain beside a vtkSMArrayListDomain, the XML element DensityArrayDomain. It takes the active
 * scalars of the points, else of the cells, else the first array that all blocks have, else the
 * first one, but never ids or flags, such as GlobalNodeId or vtkGhostType. All arrays stay on the
 * list.
 *
 * ParaView asks the domains of a property for its default in the order of their names: this one
 * needs a name before that of the list. Its required property is the Input.
 */
#ifndef vtkSMDensityArrayDomain_h
#define vtkSMDensityArrayDomain_h

#include "vtkSMDomain.h"

class vtkPVDataInformation;
class vtkSMArrayListDomain;

class vtkSMDensityArrayDomain : public vtkSMDomain
{
public:
  static vtkSMDensityArrayDomain* New();
  vtkTypeMacro(vtkSMDensityArrayDomain, vtkSMDomain);

  int IsInDomain(vtkSMProperty*) override { return NOT_APPLICABLE; }

  /**
   * Sets the association and the name, elements 3 and 4 of the property; no name where there are
   * only ids and flags. Returns 0 where there are no arrays yet.
   */
  int SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues) override;

protected:
  vtkSMDensityArrayDomain() = default;
  ~vtkSMDensityArrayDomain() override = default;

private:
  vtkSMDensityArrayDomain(const vtkSMDensityArrayDomain&) = delete;
  void operator=(const vtkSMDensityArrayDomain&) = delete;
};

#endif
