// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/CouplingCost.h"

#include "Core/OptimalMap/BalancedMap.h"
#include "Core/OptimalMap/ImageShares.h"
#include "Core/OptimalMap/Masses/NodeMasses.h"
#include "Core/OptimalMap/ResidualCoupling.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Corners a chunk of parallel loops.
constexpr std::int64_t couplingGrain = std::int64_t{ 1 } << 14;

// The images of the corners of cells, in cells: interpolates a map at nodes if these are not the
// corners themselves.
template <int Dimension>
NodeMap<Dimension> atCorners(
  NodeMap<Dimension> map, const GridSize<Dimension>& cells, Progress& progress)
{
  if (map.Grid.Cells == cells)
  {
    return map;
  }
  const auto placement = CellPlacement<Dimension>::Filling(cells, map.Grid.Cells);
  Point<Dimension> sides;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    sides[axis] = map.Grid.Spacing[axis] * placement.Sides[axis];
  }
  auto corners = NodeMap<Dimension>::On({ cells, sides });
  const std::int64_t line = cells[0] + 1;
  // i M / n rather than a sum of sides: the last corner is exactly the last node.
  const auto placeOf = [&](std::int64_t corner, int axis) {
    return static_cast<double>(corner * map.Grid.Cells[axis]) / static_cast<double>(cells[axis]);
  };
  const std::int64_t lines = std::max<std::int64_t>(1, couplingGrain / line);
  progress.For(
    corners.Grid.NumberOfNodes(), lines * line, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t begin = first; begin < last; begin += line)
      {
        Point<Dimension> at{};
        std::int64_t rest = begin / line;
        for (int axis = 1; axis < Dimension; ++axis)
        {
          at[axis] = placeOf(rest % (cells[axis] + 1), axis);
          rest /= cells[axis] + 1;
        }
        for (std::int64_t i = 0; i < line; ++i)
        {
          at[0] = placeOf(i, 0);
          const Point<Dimension> image = map.At(at.data());
          // From cells of the nodes to cells of the density.
          for (int axis = 0; axis < Dimension; ++axis)
          {
            const auto a = static_cast<std::size_t>(axis);
            corners.Images[a].data()[begin + i] = image[axis] / placement.Sides[axis];
          }
        }
      }
    });
  return corners;
}

} // namespace

// The cost of a coupling is an upper bound on the least one. Images of cells are balanced by
// Poisson corrections, shared among the cells about them, and what remains too much goes to cells
// that lack mass. Parts go by translation, so a plan between cells costs exactly |c_i - c_j|^2.
template <int Dimension>
CouplingCost couplingCost(const CellDensity<Dimension>& source,
  const CellDensity<Dimension>& target, NodeMap<Dimension> map, Progress& progress)
{
  if (source.Size() != target.Size())
  {
    throw std::invalid_argument("A coupling's cost needs densities of the same size.");
  }
  auto corners = atCorners<Dimension>(std::move(map), target.Size(), progress);
  balanceMap<Dimension>(source, target, corners, progress);
  constexpr bool withCosts = true;
  const auto shares = shareImages<Dimension>(source, target, corners, withCosts, progress);
  corners.Images = {}; // its memory is not needed any more
  // Costs are integers, in squared diagonals over integerUnit, so that their sums do not depend on
  // threads.
  const double spread =
    static_cast<double>(shares.CostOfSpread) / integerUnit * shares.SquaredDiagonal;
  return { coupleResidual(shares, target, progress), spread };
}

// The larger of two stages' needs: balancing the map, then sharing it.
template <int Dimension>
double memoryForCoupling(const GridSize<Dimension>& size, const NodeGrid<Dimension>& grid)
{
  constexpr double real = sizeof(double);
  const double cells = numberOfCells<Dimension>(size);
  const double corners =
    grid.Cells == size ? 0.0 : Dimension * real * numberOfCorners<Dimension>(size);
  // Arrays for the sums of all threads take at most 16 doubles a cell; passing the rest on takes
  // less.
  const double sharing = real * (16.0 + Dimension + 1.0) * cells;
  return corners + std::max(memoryForBalancing<Dimension>(size), sharing);
}

template decltype(couplingCost<1>) couplingCost<1>;
template decltype(couplingCost<2>) couplingCost<2>;
template decltype(couplingCost<3>) couplingCost<3>;
template decltype(memoryForCoupling<1>) memoryForCoupling<1>;
template decltype(memoryForCoupling<2>) memoryForCoupling<2>;
template decltype(memoryForCoupling<3>) memoryForCoupling<3>;

} // namespace RectifiedTransport
