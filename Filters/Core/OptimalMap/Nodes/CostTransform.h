// SPDX-License-Identifier: BSD-3-Clause
// The transform of the cost |x - y|^2 / 2 between nodes, along one axis after the other by lower
// convex hulls: O(nodes).
#ifndef RectifiedTransport_CostTransform_h
#define RectifiedTransport_CostTransform_h

#include "Core/Grid/NodeGrid.h"

namespace RectifiedTransport
{

class Progress;

// to(y) = min over the nodes x of |x - y|^2 / 2 - from(x), for finite values. `to` may be `from`.
// Adds a unit of work for each node and axis. Throws Cancelled and std::bad_alloc.
template <int Dimension>
void costTransform(
  const NodeGrid<Dimension>& grid, const double* from, double* to, Progress& progress);

// For each node y the number of the x that attains the minimum, the first one of several. Nodes
// with from(x) = -infinity do not count; at least one other must exist.
template <int Dimension>
void costMinimizers(const NodeGrid<Dimension>& grid, const double* from, std::int64_t* minimizers,
  Progress& progress);

} // namespace RectifiedTransport

#endif
