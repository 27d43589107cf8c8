// SPDX-License-Identifier: BSD-3-Clause
// The potentials of the optimal map between two densities by the back-and-forth method, from coarse
// to fine nodes, and the certified bound that they give.
#ifndef RectifiedTransport_PotentialSolver_h
#define RectifiedTransport_PotentialSolver_h

#include "Core/Grid/NodeGrid.h"
#include "Core/Grid/NodePoisson.h"
#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/Masses/NodeMasses.h"
#include "Core/OptimalMap/Nodes/NodeMap.h"
#include "Core/OptimalMap/Nodes/NodeSums.h"
#include "Core/OptimalMap/OptimalMap.h"

#include <array>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// A density and the part of the box that its cells fill: from Low to High, in fractions of the
// box's sides.
template <int Dimension>
struct BoxedDensity
{
  const CellDensity<Dimension>& Density;
  Point<Dimension> Low{};
  Point<Dimension> High{};

  // Whether the cells cover the whole box.
  bool FillsBox() const
  {
    bool fills = true;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      fills = fills && this->Low[axis] == 0.0 && this->High[axis] == 1.0;
    }
    return fills;
  }
  // Whether it is the uniform measure on the box. Its map to nodes is known, so its cells need no
  // memory.
  bool IsUniformInBox() const { return this->Density.IsUniform() && this->FillsBox(); }
  // Without voids the gradient of the potential is a map that mass determines everywhere. The
  // weighted equation raises the bound for such pairs only.
  bool HasMassEverywhere() const { return !this->Density.HasVoids() && this->FillsBox(); }
  // The affine map from its index space to cells of the nodes: Low is where cell 0 begins, Sides
  // are the sides of a cell.
  CellPlacement<Dimension> PlacementOn(const GridSize<Dimension>& nodeCells) const
  {
    CellPlacement<Dimension> placement;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto cells = static_cast<double>(nodeCells[axis]);
      placement.Low[axis] = this->Low[axis] * cells;
      placement.Sides[axis] = (this->High[axis] - this->Low[axis]) * cells /
        static_cast<double>(this->Density.Size()[axis]);
    }
    return placement;
  }
};

// One of the two densities on the nodes. All arrays have one value a node, but Cells has one a cell
// between nodes.
template <int Dimension>
struct SolverSide
{
  CellPlacement<Dimension> Placement; // where its own cells lie, in cells of the nodes
  // mu_i = integral of the hat function of node i over the density, whose whole mass is 1.
  NodeValues Hats;
  NodeValues Cells; // as cellMasses writes them; empty if it is uniform in the box
  // phi or psi, in squared lengths; c-conjugate to that of the other side after each step.
  NodeValues Potential;

  const double* CellsOrNull() const
  {
    return this->Cells.size() > 0 ? this->Cells.data() : nullptr;
  }
};

// Maximizes the dual of the quadratic cost |x - y|^2 / 2 (Jacobs and Leger, "A fast approach to
// optimal transport: the back-and-forth method", 2020). Side 0 is the source, 1 the target. Lengths
// are such that the squared diagonal of the box is not far from 1.
template <int Dimension>
class PotentialSolver
{
public:
  // Throws std::invalid_argument if a side is more than 1e120 times as long as another one.
  PotentialSolver(const BoxedDensity<Dimension>& source, const BoxedDensity<Dimension>& target,
    const Point<Dimension>& sides, const OptimalMapOptions& options);

  // Throws std::bad_alloc and Cancelled.
  void Solve(Progress& progress);

  const NodeGrid<Dimension>& Grid() const { return this->Nodes; }
  const SolverSide<Dimension>& Side(int side) const { return this->Sides[Index(side)]; }
  const CellDensity<Dimension>& Density(int side) const { return this->Given[Index(side)].Density; }
  // Not above the least squared distance; may be below 0.
  double Bound() const { return this->BoundNow - this->Rounding; }
  // The bound on twice as many nodes along each axis, if they are not more than the most, else
  // Bound. Throws std::bad_alloc and Cancelled.
  double RefinedBound(Progress& progress) const;
  int Iterations() const { return this->FineIterations; }

  // Bytes a node of the finest grid that Solve holds at most.
  static double BytesANode(int threads);
  // Bytes that RefinedBound takes besides.
  static double MemoryForRefined(const GridSize<Dimension>& cells, double mostNodes);

private:
  struct Scratch;

  static std::size_t Index(int i) { return static_cast<std::size_t>(i); }
  void MakeCells(const std::vector<GridSize<Dimension>>& levels, Progress& progress);
  void Begin(const std::vector<GridSize<Dimension>>& levels, std::size_t level,
    NodeValues potential, Progress& progress);
  void Iterate(Scratch& scratch, bool isFinest, Progress& progress);
  void HalfStep(Scratch& scratch, int side, Progress& progress);
  void FindDefect(Scratch& scratch, int side, Progress& progress) const;
  double Dual(const double* source, const double* target, Progress& progress) const;

  const std::array<BoxedDensity<Dimension>, 2> Given;
  const Point<Dimension> Lengths;
  const OptimalMapOptions Options;
  // What rounding may add to the bound, in squared lengths.
  const double Rounding;
  bool IsWeighted;
  // Masses on the levels to come; none if uniform.
  std::array<std::vector<NodeValues>, 2> LevelCells;

  // On the present level's nodes: the nodes themselves, both sides, and each side's step length.
  NodeGrid<Dimension> Nodes;
  std::array<SolverSide<Dimension>, 2> Sides;
  std::array<double, 2> Steps{};
  // What lumping the masses at nodes adds to the cost, summed over both sides, in squared lengths.
  double Excess = 0.0;
  double BoundNow = 0.0;
  int FineIterations = 0;
};

} // namespace RectifiedTransport

#endif
