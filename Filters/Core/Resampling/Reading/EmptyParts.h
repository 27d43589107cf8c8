// SPDX-License-Identifier: BSD-3-Clause
// What the cells of data sets do not cover of a grid.
#ifndef RectifiedTransport_EmptyParts_h
#define RectifiedTransport_EmptyParts_h

#include "Core/Resampling/Reading/SetReading.h"
#include "Core/Tables/Reading/DensityRules.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Adds to the values of `cells` grid cells the density of the part of each that no counted cell
// covers; `covered` are the other parts. Returns this density. Throws Cancelled.
double fillEmptyParts(const double* covered, std::int64_t cells,
  const std::vector<SetFindings>& findings, const EmptyRule& rule, Progress& progress,
  double* values);

} // namespace RectifiedTransport

#endif
