// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMDensityArrayDomain
 * @brief   which arrays of an input may be its density, and which one is at first
 *
 * The list of an input's arrays, in XML the element DensityArrayDomain, without the ghost flags. At
 * first it takes an array of one component, else one of several: the active scalars of the points,
 * else of the cells, else the first array that all blocks have, else the first one. It never takes
 * ids or flags, such as GlobalNodeId, nor text, which the user may choose. With a required property
 * Namesake, another array of this kind, an array of that name comes before all others, also
 * whenever the namesake changes, until the user chooses one.
 *
 * Where the panel changes the input, as the Domain of Equal Mass Cells, it takes the first array of
 * the new input if that has not the chosen one. A property without a name, as of a filter that was
 * made before its input was read, gets one as soon as there are arrays.
 */
#ifndef vtkSMDensityArrayDomain_h
#define vtkSMDensityArrayDomain_h

#include "vtkSMArrayListDomain.h"

#include <string>

class vtkSMDensityArrayDomain : public vtkSMArrayListDomain
{
public:
  static vtkSMDensityArrayDomain* New();
  vtkTypeMacro(vtkSMDensityArrayDomain, vtkSMArrayListDomain);

  void Update(vtkSMProperty* requestingProperty) override;

  /**
   * Sets the association and the name, elements 3 and 4 of the property; no name where there are
   * only ids, flags and text. Returns 0 where there are no arrays yet.
   */
  int SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues) override;

protected:
  vtkSMDensityArrayDomain() = default;
  ~vtkSMDensityArrayDomain() override = default;

  bool IsFilteredArray(
    vtkPVDataInformation* information, int association, const char* name) override;

private:
  std::string FirstChoice; // the last one
  bool IsWaiting = false;  // for arrays, to make the first choice

  vtkSMDensityArrayDomain(const vtkSMDensityArrayDomain&) = delete;
  void operator=(const vtkSMDensityArrayDomain&) = delete;
};

#endif
