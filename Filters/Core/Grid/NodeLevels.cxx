// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Grid/NodeLevels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

namespace
{

// An axis of at most so many cells is not halved any more: the coarsest nodes still resolve the
// density's shape.
constexpr std::int64_t fewestCells = 12;

// The cosine transform of a line needs an even number of cells, at least 2.
std::int64_t evenAtLeast(double cells)
{
  return std::max<std::int64_t>(2, 2 * static_cast<std::int64_t>(std::ceil(0.5 * cells)));
}

} // namespace

// The wanted number of cells along an axis is that of the finest density, from the shorter sides of
// cells in fractions of the box.
template <int Dimension>
GridSize<Dimension> finestNodeCells(
  const std::vector<Point<Dimension>>& cellSides, double mostNodes)
{
  Point<Dimension> wanted;
  double all = 1.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    double shortest = 1.0;
    for (const Point<Dimension>& sides : cellSides)
    {
      shortest = std::min(shortest, sides[axis]);
    }
    wanted[axis] = std::round(1.0 / shortest);
    all *= wanted[axis];
  }
  // Few cells are doubled along each axis, as nodes cost little then and the bound's error falls by
  // 4 each time.
  double factor = 1.0;
  for (; all * factor < fewCells<Dimension>; factor *= std::ldexp(1.0, Dimension))
  {
    for (double& cells : wanted)
    {
      cells *= 2.0;
    }
  }
  // More nodes than the most are thinned by the same factor along each axis.
  all *= factor;
  const double ratio = all > mostNodes ? std::pow(mostNodes / all, 1.0 / Dimension) : 1.0;
  GridSize<Dimension> cells;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    cells[axis] = evenAtLeast(wanted[axis] * ratio);
  }
  return cells;
}

// Each level has half the cells of the next one along each axis, rounded up to an even number; the
// coarsest comes first.
template <int Dimension>
std::vector<GridSize<Dimension>> nodeLevels(const GridSize<Dimension>& finest)
{
  std::vector<GridSize<Dimension>> levels{ finest };
  for (;;)
  {
    GridSize<Dimension> next = levels.back();
    for (std::int64_t& cells : next)
    {
      cells = cells <= fewestCells ? cells : evenAtLeast(0.5 * static_cast<double>(cells));
    }
    if (next == levels.back())
    {
      break;
    }
    levels.push_back(next);
  }
  std::reverse(levels.begin(), levels.end());
  return levels;
}

// Nodes over a box of `size` cells with `sides`, `cellsANode` cells apart, in an even number of
// cells.
template <int Dimension>
NodeGrid<Dimension> nodesOver(
  const GridSize<Dimension>& size, const Point<Dimension>& sides, int cellsANode)
{
  NodeGrid<Dimension> grid;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const std::int64_t cells = (size[axis] + cellsANode - 1) / cellsANode;
    grid.Cells[axis] = std::max<std::int64_t>(2, cells + cells % 2);
    grid.Spacing[axis] =
      sides[axis] * static_cast<double>(size[axis]) / static_cast<double>(grid.Cells[axis]);
  }
  return grid;
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(nodesOver);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(finestNodeCells);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(nodeLevels);

} // namespace RectifiedTransport
