// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/CouplingCost.h"

#include "Core/Grid/GradientField.h"
#include "Core/Grid/NodeLevels.h"
#include "Core/Grid/NodePoisson.h"
#include "Core/OptimalMap/ImageShares.h"
#include "Core/OptimalMap/Masses/NodeMasses.h"
#include "Core/OptimalMap/ResidualCoupling.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Steps of preconditioned conjugate gradients in each of both corrections. The second one starts
// from less excess and needs fewer.
constexpr std::array<int, 2> iterations = { 6, 4 }; // in each correction
constexpr double leastWeight = 0.1;                 // in units of the mean density
constexpr std::int64_t balanceGrain = std::int64_t{ 1 } << 14;

// The grid on which Poisson's equation is solved. Its cells are two cells wide, or one where cells
// are few, as it costs little there.
template <int Dimension>
NodeGrid<Dimension> balancingNodes(const NodeGrid<Dimension>& corners)
{
  const bool areFew = numberOfCells<Dimension>(corners.Cells) < fewCells<Dimension>;
  return nodesOver<Dimension>(corners.Cells, corners.Spacing, areFew ? 1 : 2);
}

// The residual at nodes: the masses that cells got beyond their shares, summed by the nodes' hats.
// A mass of 1 is the whole.
template <int Dimension>
NodeValues findExcess(const CellDensity<Dimension>& source, const CellDensity<Dimension>& target,
  const NodeMap<Dimension>& corners, const NodeGrid<Dimension>& nodes, Progress& progress)
{
  constexpr bool withCosts = false;
  const auto shares = shareImages<Dimension>(source, target, corners, withCosts, progress);
  NodeValues residual(target.NumberOfCells());
  double* values = residual.data();
  progress.ForEach(residual.size(), balanceGrain, [&](std::int64_t cell) {
    values[cell] = static_cast<double>(shares.ResidualOf(cell, target)) / integerUnit;
  });
  return hatSums<Dimension>(values, target.Size(), nodes, progress);
}

// Moves the images of corners by the field at nodes, interpolated there, and keeps them in the box.
template <int Dimension>
void moveCorners(const GradientField<Dimension>& moves, const CellPlacement<Dimension>& toNodes,
  NodeMap<Dimension>& corners, Progress& progress)
{
  progress.ForEach(corners.Grid.NumberOfNodes(), balanceGrain, [&](std::int64_t corner) {
    Point<Dimension> at;
    for (std::size_t axis = 0; axis < at.size(); ++axis)
    {
      at[axis] = corners.Images[axis].data()[corner];
    }
    const Point<Dimension> move = moves.At(toNodes.ToNodes(at.data()).data());
    for (std::size_t axis = 0; axis < at.size(); ++axis)
    {
      corners.Images[axis].data()[corner] = std::clamp(at[axis] + move[axis] / toNodes.Sides[axis],
        0.0, static_cast<double>(corners.Grid.Cells[axis]));
    }
  });
}

// Corrects a map between two densities, so that cells get the masses of the target. Moves the
// images of the cells' corners, which are given in cells, by two corrections. Each goes down the
// gradient of the solution of Poisson's equation, weighted by the target, for the excess that
// shareImages leaves in cells. Nodes are two cells apart unless cells are few, so that errors
// within some cells are left. Both densities have the size of the map's grid. The result has the
// same bits for every number of threads. Throws std::bad_alloc and Cancelled. Each correction is a
// step of -div(max(target, .1) grad q) = image - target and a move by -grad q, as in
// MassCorrection.h, but for the corners of cells: their images then carry the masses of whole
// cells.
template <int Dimension>
void balanceMap(const CellDensity<Dimension>& source, const CellDensity<Dimension>& target,
  NodeMap<Dimension>& corners, Progress& progress)
{
  const NodeGrid<Dimension> nodes = balancingNodes(corners.Grid);
  // From cells of the density to cells of the nodes.
  const auto toNodes = CellPlacement<Dimension>::Filling(target.Size(), nodes.Cells);
  const NodeValues wanted = hatMasses<Dimension>(target, toNodes, nodes, progress);
  NodePoisson<Dimension> poisson(nodes);
  NodeValues q(nodes.NumberOfNodes());
  for (const int each : iterations)
  {
    const NodeValues excess = findExcess(source, target, corners, nodes, progress);
    poisson.SolveWeighted(excess.data(), wanted.data(), leastWeight, each, q.data(), progress);
    moveCorners(GradientField<Dimension>(nodes, q.data(), progress), toNodes, corners, progress);
  }
}

// Bytes that it takes at most, about.
template <int Dimension>
double memoryForBalancing(const GridSize<Dimension>& cells)
{
  constexpr double arrays = 3.0 + Dimension; // excess, target's masses, solution; and the moves
  // The sums' arrays of all threads, the cells' excess, and its sums along an axis.
  constexpr double arraysOfCells = mostArraysOfSums + 2.0;
  const NodeGrid<Dimension> nodes = balancingNodes<Dimension>({ cells });
  return sizeof(double) *
    (arraysOfCells * numberOfCells<Dimension>(cells) +
      arrays * numberOfCorners<Dimension>(nodes.Cells)) +
    NodePoisson<Dimension>::MemoryFor(nodes, true);
}

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

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(couplingCost);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(memoryForCoupling);

} // namespace RectifiedTransport
