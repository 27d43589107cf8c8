// SPDX-License-Identifier: BSD-3-Clause
// The last step of a coupling of cells: what some got beyond their shares goes on to others.
#ifndef RectifiedTransport_ResidualCoupling_h
#define RectifiedTransport_ResidualCoupling_h

#include "Core/OptimalMap/ImageShares.h"

namespace RectifiedTransport
{

class Progress;

// Passes excess to the nearest cells that got too little, then along a space-filling curve. Returns
// the cost of the coupling, in which what rounding left counts as if it had to cross the whole box.
// Throws std::bad_alloc and Cancelled.
template <int Dimension>
double coupleResidual(
  const CellShares<Dimension>& shares, const CellDensity<Dimension>& target, Progress& progress);

} // namespace RectifiedTransport

#endif
