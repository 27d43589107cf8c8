// SPDX-License-Identifier: BSD-3-Clause
// What the tables find in a density while they read it.
#ifndef RectifiedTransport_DensityInspection_h
#define RectifiedTransport_DensityInspection_h

#include "Core/Tables/Density.h"
#include "Core/Tables/Kernels/TableKernels.h"

#include <cstdint>

namespace RectifiedTransport
{

// Inspects part of a row of cells, the first of which has the index `index`, and sets one bit a
// cell that has mass. Adds to all of `found` but the total.
RowInspection inspectCells(const double* values, std::int64_t count, std::int64_t index,
  std::uint64_t* words, DensitySummary& found);

// Adds what was found in one part to what was found in others.
void merge(const DensitySummary& part, DensitySummary& whole);

} // namespace RectifiedTransport

#endif
