// SPDX-License-Identifier: BSD-3-Clause
// All filters, each with a crafted input on one of its ports and a sound one on the other.
#ifndef Campaign_CraftedFilters_h
#define Campaign_CraftedFilters_h

#include "RandomSource.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace Campaign
{

struct CraftedFilter
{
  const char* Name;
  const char* Takes; // the least class of the crafted input
  vtkSmartPointer<vtkAlgorithm> (*New)(RandomSource& random, vtkDataObject* crafted);
};

const std::vector<CraftedFilter>& craftedFilters();

} // namespace Campaign

#endif
