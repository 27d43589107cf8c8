// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/BalancedMap.h"

#include "Core/Grid/GradientField.h"
#include "Core/Grid/NodeLevels.h"
#include "Core/Grid/NodePoisson.h"
#include "Core/OptimalMap/ImageShares.h"
#include "Core/OptimalMap/Masses/NodeMasses.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

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

} // namespace

// Each correction is a step of -div(max(target, .1) grad q) = image - target and a move by -grad q,
// as in MassCorrection.h, but for the corners of cells: their images then carry the masses of whole
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

template void balanceMap<1>(const CellDensity<1>&, const CellDensity<1>&, NodeMap<1>&, Progress&);
template void balanceMap<2>(const CellDensity<2>&, const CellDensity<2>&, NodeMap<2>&, Progress&);
template void balanceMap<3>(const CellDensity<3>&, const CellDensity<3>&, NodeMap<3>&, Progress&);
template double memoryForBalancing<1>(const GridSize<1>&);
template double memoryForBalancing<2>(const GridSize<2>&);
template double memoryForBalancing<3>(const GridSize<3>&);

} // namespace RectifiedTransport
