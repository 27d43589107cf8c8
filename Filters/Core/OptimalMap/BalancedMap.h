// SPDX-License-Identifier: BSD-3-Clause
// Corrections of a map between two densities, so that cells get the masses of the target.
#ifndef RectifiedTransport_BalancedMap_h
#define RectifiedTransport_BalancedMap_h

#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/Nodes/NodeMap.h"

namespace RectifiedTransport
{

class Progress;

// Moves the images of the cells' corners, which are given in cells, by two corrections. Each goes
// down the gradient of the solution of Poisson's equation, weighted by the target, for the excess
// that shareImages leaves in cells. Nodes are two cells apart unless cells are few, so that errors
// within some cells are left. Both densities have the size of the map's grid. The result
// has the same bits for every number of threads. Throws std::bad_alloc and Cancelled.
template <int Dimension>
void balanceMap(const CellDensity<Dimension>& source, const CellDensity<Dimension>& target,
  NodeMap<Dimension>& corners, Progress& progress);

// Bytes that it takes at most, about.
template <int Dimension>
double memoryForBalancing(const GridSize<Dimension>& cells);

} // namespace RectifiedTransport

#endif
