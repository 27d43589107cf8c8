// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/BalancedMap.h"

#include "Core/Grid/NodeLevels.h"
#include "Core/Grid/NodeMoves.h"
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

constexpr std::array<int, 2> iterations = { 6, 4 }; // of each correction
constexpr double leastWeight = 0.1;                 // of the mean density
constexpr std::int64_t grain = std::int64_t{ 1 } << 14;

// Cells between nodes are two cells wide, where these are few one.
template <int Dimension>
NodeGrid<Dimension> balancingNodes(const NodeGrid<Dimension>& corners)
{
  const bool areFew = numberOfCells<Dimension>(corners.Cells) < fewCells<Dimension>;
  return nodesOver<Dimension>(corners.Cells, corners.Spacing, areFew ? 1 : 2);
}

template <int Dimension>
class Balancing
{
public:
  Balancing(const CellDensity<Dimension>& source, const CellDensity<Dimension>& target,
    NodeMap<Dimension>& corners, Progress& progress)
    : Source(source)
    , Target(target)
    , Corners(corners)
    , Nodes(balancingNodes(corners.Grid))
    , Work(progress)
  {
  }

  void Run()
  {
    const auto placement =
      CellPlacement<Dimension>::Filling(this->Target.Size(), this->Nodes.Cells);
    const NodeValues wanted =
      hatMasses<Dimension>(this->Target, placement, this->Nodes, this->Work);
    NodePoisson<Dimension> poisson(this->Nodes);
    NodeValues q(this->Nodes.NumberOfNodes());
    for (const int each : iterations)
    {
      const NodeValues excess = this->FindExcess();
      poisson.SolveWeighted(excess.data(), wanted.data(), leastWeight, each, q.data(), this->Work);
      this->Move(NodeMoves<Dimension>(this->Nodes, q.data(), this->Work));
    }
  }

private:
  // What the nodes' hats have of the masses that cells get too much.
  NodeValues FindExcess()
  {
    constexpr bool withCosts = false;
    const auto shares =
      shareImages<Dimension>(this->Source, this->Target, this->Corners, withCosts, this->Work);
    NodeValues rest(this->Target.NumberOfCells());
    double* values = rest.data();
    this->Work.ForEach(rest.size(), grain, [&](std::int64_t cell) {
      values[cell] = static_cast<double>(shares.RestOf(cell, this->Target)) / integerUnit;
    });
    return hatSums<Dimension>(values, this->Target.Size(), this->Nodes, this->Work);
  }

  void Move(const NodeMoves<Dimension>& moves)
  {
    const auto toNodes = CellPlacement<Dimension>::Filling(this->Target.Size(), this->Nodes.Cells);
    std::array<double*, Dimension> images;
    for (std::size_t axis = 0; axis < images.size(); ++axis)
    {
      images[axis] = this->Corners.Images[axis].data();
    }
    const std::int64_t corners = this->Corners.Grid.NumberOfNodes();
    this->Work.ForEach(corners, grain, [&](std::int64_t corner) {
      Point<Dimension> at;
      for (std::size_t axis = 0; axis < images.size(); ++axis)
      {
        at[axis] = images[axis][corner];
      }
      const Point<Dimension> move = moves.At(toNodes.ToNodes(at.data()).data());
      for (std::size_t axis = 0; axis < images.size(); ++axis)
      {
        images[axis][corner] = std::clamp(at[axis] + move[axis] / toNodes.Sides[axis], 0.0,
          static_cast<double>(this->Corners.Grid.Cells[axis]));
      }
    });
  }

  const CellDensity<Dimension>& Source;
  const CellDensity<Dimension>& Target;
  NodeMap<Dimension>& Corners;
  const NodeGrid<Dimension> Nodes;
  Progress& Work;
};

} // namespace

template <int Dimension>
void balanceMap(const CellDensity<Dimension>& source, const CellDensity<Dimension>& target,
  NodeMap<Dimension>& corners, Progress& progress)
{
  Balancing<Dimension>(source, target, corners, progress).Run();
}

template <int Dimension>
double memoryForBalancing(const GridSize<Dimension>& cells)
{
  constexpr double arrays = 3.0 + Dimension; // excess, target's masses and solution; moves
  // Sums of threads, what cells got too much, and its sums along an axis.
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
