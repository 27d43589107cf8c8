// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/Masses/MassCorrection.h"

#include "Core/Grid/NodeLevels.h"
#include "Core/Grid/NodePoisson.h"
#include "Core/OptimalMap/Nodes/NodeSums.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

// The number of corrections, as more of them converge slowly. Each solves its equation by so many
// steps of preconditioned conjugate gradients. A lower floor of the weight needs more steps and
// moves what stands still over a faint background; a higher one leaves more error in thin parts.
constexpr int steps = 2;
constexpr int massIterations = 6;
constexpr double leastMassWeight = 0.3; // in units of the mean density

} // namespace

// Linearized mass balance: moving images by -grad q changes their density by div(target grad q),
// which should remove the excess image - target. Hence -div(max(target, .3) grad q) = image -
// target, whose solution moves mass down the gradient of q.
template <int Dimension>
MassCorrection<Dimension>::MassCorrection(const CellDensity<Dimension>& target,
  const Point<Dimension>& sides, int cellsANode, PointSpan<Dimension> images, const double* masses,
  Progress& progress)
  : Target(target)
{
  const NodeGrid<Dimension> grid = nodesOver<Dimension>(target.Size(), sides, cellsANode);
  this->Placement = CellPlacement<Dimension>::Filling(target.Size(), grid.Cells);
  if (images.size() == 0)
  {
    return;
  }
  // The target's masses of the hats, and the same hats' masses of the images: their difference is
  // the residual.
  const NodeValues wanted = hatMasses<Dimension>(target, this->Placement, grid, progress);
  const std::int64_t nodes = grid.NumberOfNodes();
  NodePoisson<Dimension> poisson(grid);
  NodeValues excess(nodes);
  NodeValues q(nodes);
  NodeSums<Dimension> sums(grid, 1.0, images.size(), progress);
  const double equal = 1.0 / static_cast<double>(images.size());
  for (int step = 0; step < steps; ++step)
  {
    progress.For(
      images.size(), std::int64_t{ 1 } << 14, [&](std::int64_t first, std::int64_t last) {
        typename NodeSums<Dimension>::Part part(sums);
        for (std::int64_t i = first; i < last; ++i)
        {
          part.Add(masses ? masses[i] : equal, this->Placement.ToNodes(images[i]).data());
        }
      });
    sums.Write(excess.data(), progress,
      [&](std::int64_t node, double sum) { return sum - wanted.data()[node]; });
    poisson.SolveWeighted(
      excess.data(), wanted.data(), leastMassWeight, massIterations, q.data(), progress);
    this->Moves.emplace_back(grid, q.data(), progress);
    const GradientField<Dimension>& moves = this->Moves.back();
    progress.ForEach(images.size(), std::int64_t{ 1 } << 11,
      [&](std::int64_t i) { this->Step(moves, images[i]); });
  }
}

// Moves one image, unless it ended in a void. The whole move is tried first, then halves of it.
template <int Dimension>
void MassCorrection<Dimension>::Step(const GradientField<Dimension>& moves, double* point) const
{
  const Point<Dimension> at = this->Placement.ToNodes(point);
  const Point<Dimension> move = moves.At(at.data());
  // A move that ends in a void even at an eighth is left out.
  for (const double part : { 1.0, 0.5, 0.25, 0.125 })
  {
    Point<Dimension> to;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      to[axis] = std::clamp(point[axis] + part * move[axis] / this->Placement.Sides[axis], 0.0,
        static_cast<double>(this->Target.Size()[axis]));
    }
    if (this->Target.HasMass(to.data()))
    {
      std::copy(to.begin(), to.end(), point);
      return;
    }
  }
}

// Applies the moves of all steps, in their order.
template <int Dimension>
void MassCorrection<Dimension>::Move(double* point) const
{
  for (const GradientField<Dimension>& moves : this->Moves)
  {
    this->Step(moves, point);
  }
}

// Undoes each move by a fixed-point iteration, last move first: x with x + m(x) = y is the limit of
// x <- y - m(x), which converges where |grad m| < 1, as it is for corrections of smooth maps.
template <int Dimension>
void MassCorrection<Dimension>::Undo(double* point) const
{
  constexpr int most = 8;
  constexpr double close = 1e-3; // in cells of the nodes
  for (auto moves = this->Moves.rbegin(); moves != this->Moves.rend(); ++moves)
  {
    // In cells of the nodes, where moves are given.
    const Point<Dimension> moved = this->Placement.ToNodes(point);
    Point<Dimension> before = moved;
    double change = 1.0;
    for (int iteration = 0; iteration < most && change > close; ++iteration)
    {
      const Point<Dimension> move = moves->At(before.data());
      change = 0.0;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const double to =
          std::clamp(moved[axis] - move[axis], 0.0, static_cast<double>(moves->Size()[axis]));
        change = std::max(change, std::abs(to - before[axis]));
        before[axis] = to;
      }
    }
    const Point<Dimension> to = this->Placement.FromNodes(before.data());
    std::copy(to.begin(), to.end(), point);
  }
}

// The target's hats, excess and q, arrays for the deposit on all threads, the solver's memory, and
// what is kept.
template <int Dimension>
double MassCorrection<Dimension>::MemoryFor(const GridSize<Dimension>& target, int cellsANode)
{
  const NodeGrid<Dimension> grid = nodesOver<Dimension>(target, Point<Dimension>{}, cellsANode);
  return numberOfCorners<Dimension>(grid.Cells) * sizeof(double) * (3.0 + mostArraysOfSums) +
    NodePoisson<Dimension>::MemoryFor(grid, true) + MemoryKept(target, cellsANode);
}

// One vector a node for each step.
template <int Dimension>
double MassCorrection<Dimension>::MemoryKept(const GridSize<Dimension>& target, int cellsANode)
{
  const NodeGrid<Dimension> grid = nodesOver<Dimension>(target, Point<Dimension>{}, cellsANode);
  return numberOfCorners<Dimension>(grid.Cells) * sizeof(double) * steps * Dimension;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(MassCorrection);

} // namespace RectifiedTransport
