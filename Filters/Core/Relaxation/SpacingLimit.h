// SPDX-License-Identifier: BSD-3-Clause
// A bound of the spacings, and so of the widths of kernels, for points that are far from
// distributed like the density: many of them in a place that should have few would all be
// neighbours.
#ifndef RectifiedTransport_SpacingLimit_h
#define RectifiedTransport_SpacingLimit_h

#include "Core/Relaxation/SpacingTree.h"

namespace RectifiedTransport
{

// The largest spacing, of 1 and more, with which points have an affordable number of neighbours on
// the average; infinity if none is too large. `reach` is that of ReachTree.
template <int Dimension>
double affordableSpacing(const SpacingTree<Dimension>& tree, ConstPointSpan<Dimension> points,
  double reach, Progress& progress);

} // namespace RectifiedTransport

#endif
