// SPDX-License-Identifier: BSD-3-Clause
// Checks of a density's values while the tables read them.
#ifndef RectifiedTransport_DensityInspection_h
#define RectifiedTransport_DensityInspection_h

#include "Core/Tables/Density.h"
#include "Core/Tables/Kernels/TableKernels.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Inspects part of a row of grid cells, beginning at the index `index`, and sets one bit of `words`
// for each cell that has mass. Adds to all members of `found` except the total.
RowInspection inspectCells(const double* values, std::int64_t count, std::int64_t index,
  std::uint64_t* words, DensitySummary& found);

// The summary of values of which the first has the index `index`. Adds them up in their order.
DensitySummary summarize(const double* values, std::int64_t count, std::int64_t index);
// The summary of the values of `count` cells. Throws std::bad_alloc and Cancelled.
DensitySummary summarize(const DensityValues& density, std::int64_t count, Progress& progress);

// Adds the summary of a part to that of the whole.
void merge(const DensitySummary& part, DensitySummary& whole);

// Throws InvalidDensity if the summarized density has no transport.
void requireDensity(const DensitySummary& found);

} // namespace RectifiedTransport

#endif
