// SPDX-License-Identifier: BSD-3-Clause
// The grids of nodes of a box, from coarse to fine.
#ifndef RectifiedTransport_NodeLevels_h
#define RectifiedTransport_NodeLevels_h

#include "Core/Grid/NodeGrid.h"

#include <vector>

namespace RectifiedTransport
{

// Few cells cost little, and a bound is as much better as nodes are closer.
template <int Dimension>
constexpr double fewCells = Dimension == 3 ? 0x1p14 : 0x1p11;

// The finest cells between nodes for densities whose cells have these sides, in fractions of the
// box: as many as cells of the shortest sides would be. While these are few, they are halved along
// all axes; if they are more than `mostNodes`, there are about so many.
template <int Dimension>
GridSize<Dimension> finestNodeCells(
  const std::vector<Point<Dimension>>& cellSides, double mostNodes);

// From the coarsest to the finest. Each has about half the cells of the next one along each axis
// that has many.
template <int Dimension>
std::vector<GridSize<Dimension>> nodeLevels(const GridSize<Dimension>& finest);

// One cell between nodes for each block of `cellsANode` cells a side, of a grid of cells of these
// sides; an even number along each axis.
template <int Dimension>
NodeGrid<Dimension> nodesOver(
  const GridSize<Dimension>& size, const Point<Dimension>& sides, int cellsANode);

} // namespace RectifiedTransport

#endif
