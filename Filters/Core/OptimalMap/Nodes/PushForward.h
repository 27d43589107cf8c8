// SPDX-License-Identifier: BSD-3-Clause
// What a map makes of a density, as masses of nodes.
#ifndef RectifiedTransport_PushForward_h
#define RectifiedTransport_PushForward_h

#include "Core/OptimalMap/Nodes/NodeMap.h"
#include "Core/OptimalMap/Nodes/NodeSums.h"

namespace RectifiedTransport
{

// Adds the masses of the nodes' hats in the image of a density, of which the cells between the
// nodes have the masses `cells`, null if each has 1. Adds a unit of work a cell. Throws
// std::bad_alloc and Cancelled.
template <int Dimension>
void pushForward(const NodeMap<Dimension>& map, const double* cells, const SampleFineness& fineness,
  NodeSums<Dimension>& sums, Progress& progress);

} // namespace RectifiedTransport

#endif
