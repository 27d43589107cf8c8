// SPDX-License-Identifier: BSD-3-Clause
// How much of a density is in a box (paper, Section 3.3), for what needs it outside of the kernels.
#ifndef RectifiedTransport_BoxShare_h
#define RectifiedTransport_BoxShare_h

#include "Density.h"
#include "TableView.h"

namespace RectifiedTransport
{

// The share of the mass in the part of a box that is in the domain, in [0,1], exactly up to the
// rounding of the sums.
template <int Dimension>
double boxShare(
  const TableView<Dimension>& tables, const Point<Dimension>& low, const Point<Dimension>& high);

} // namespace RectifiedTransport

#endif
