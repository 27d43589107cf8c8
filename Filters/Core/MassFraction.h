// SPDX-License-Identifier: BSD-3-Clause
// The mass of any box (paper, Section 3.3), for what needs a few of them outside of the kernels.
#ifndef RectifiedTransport_MassFraction_h
#define RectifiedTransport_MassFraction_h

#include "Density.h"
#include "TableView.h"

namespace RectifiedTransport
{

// The part of the mass that lies in a box, in [0,1].
template <int Dimension>
double massFraction(
  const TableView<Dimension>& tables, const Point<Dimension>& low, const Point<Dimension>& high);

} // namespace RectifiedTransport

#endif
