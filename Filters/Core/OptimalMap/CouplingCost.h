// SPDX-License-Identifier: BSD-3-Clause
// An upper bound of the optimal cost between two densities on one grid: the cost of a coupling of
// their cells with exact marginals.
#ifndef RectifiedTransport_CouplingCost_h
#define RectifiedTransport_CouplingCost_h

#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/Nodes/NodeMap.h"

namespace RectifiedTransport
{

class Progress;

// In squared lengths.
struct CouplingCost
{
  double All = 0.0;
  // The part of it that images take because they lie between cells, about the same for all maps.
  double OfSpread = 0.0;
};

// Follows the map from the source, whose images are corrected (balanceMap) and then shared among
// the target's cells (ImageShares.h); what a cell gets beyond its share goes on to cells nearby
// that got too little, then along a space-filling curve (ResidualCoupling.h). Uniform parts of
// cells go by translation, so that the cost of the coupling is known exactly; masses are integers,
// and what rounding leaves counts as if it had to cross the whole box. In the squared lengths of
// the map's spacing; the nodes fill the box of the densities. Both densities have the same size.
//
// The same bits for every number of threads. Adds about 15 units of work a cell on a line, 50 in
// the plane and 30 in space, and those of two solutions of NodePoisson on nodes two cells apart.
// Throws std::invalid_argument for different sizes, std::bad_alloc and Cancelled.
template <int Dimension>
CouplingCost couplingCost(const CellDensity<Dimension>& source,
  const CellDensity<Dimension>& target, NodeMap<Dimension> map, Progress& progress);

// Bytes that it takes at most, about.
template <int Dimension>
double memoryForCoupling(const GridSize<Dimension>& size, const NodeGrid<Dimension>& grid);

} // namespace RectifiedTransport

#endif
