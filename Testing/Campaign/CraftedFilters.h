// SPDX-License-Identifier: BSD-3-Clause
// All filters of the register, each with a crafted input on one of its ports and sound ones on the
// others that it needs.
#ifndef Campaign_CraftedFilters_h
#define Campaign_CraftedFilters_h

#include "FilterKind.h"

#include <string>
#include <vector>

namespace Campaign
{

struct CraftedFilter
{
  std::string Name;
  const FilterKind* Kind;
  int Port;          // of the crafted input
  std::string Takes; // its least class
};

vtkSmartPointer<vtkAlgorithm> newCrafted(
  const CraftedFilter& filter, RandomSource& random, vtkDataObject* crafted);

const std::vector<CraftedFilter>& craftedFilters();

} // namespace Campaign

#endif
