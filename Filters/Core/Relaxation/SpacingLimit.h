// SPDX-License-Identifier: BSD-3-Clause
// A bound of the spacings, and so of the widths of kernels, for points distributed very differently
// from the density: many points in a place that should have few would all be neighbours.
#ifndef RectifiedTransport_SpacingLimit_h
#define RectifiedTransport_SpacingLimit_h

#include "Core/Relaxation/SpacingTree.h"

namespace RectifiedTransport
{

// The largest spacing, at least 1, with which points have an affordable number of neighbours on
// average; infinity if none is too large. `reach` is that of NeighbourTree.
template <int Dimension>
double affordableSpacing(const SpacingTree<Dimension>& tree, ConstPointSpan<Dimension> points,
  double reach, Progress& progress);

} // namespace RectifiedTransport

#endif
