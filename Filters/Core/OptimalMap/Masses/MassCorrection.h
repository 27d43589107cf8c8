// SPDX-License-Identifier: BSD-3-Clause
// Moves the images of a map so that their masses agree better with the target's: two steps down the
// gradient of q, where -div(max(target, .3) grad q) = image - target.
#ifndef RectifiedTransport_MassCorrection_h
#define RectifiedTransport_MassCorrection_h

#include "Core/Grid/GradientField.h"
#include "Core/Grid/NodeGrid.h"
#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/Masses/NodeMasses.h"

#include <vector>

namespace RectifiedTransport
{

class Progress;

// Points are in the index space of the target, in its box. None leaves the box, and none goes into
// an empty cell: moves that would are halved up to three times, then left out.
template <int Dimension>
class MassCorrection
{
public:
  // From the images of samples, which it moves, too, and their masses, which sum to 1; without
  // masses all are equal. `sides` are those of the target's cells, in lengths. Nodes fill the
  // target's box: one for each cell, or for each block of `cellsANode` cells a side, an even number
  // along each axis. The target must live as long. Keeps a vector a node for each step. The same
  // bits for every number of threads. Adds, for each step, units of work: twice the number of
  // images, the nodes, and those of a solution of NodePoisson. Not collective. Throws
  // std::bad_alloc and Cancelled.
  MassCorrection(const CellDensity<Dimension>& target, const Point<Dimension>& sides,
    int cellsANode, PointSpan<Dimension> images, const double* masses, Progress& progress);

  // Moves other images in the same way.
  void Move(double* point) const;
  // Moves an image back to where Move moves from, near enough, wherever there is mass.
  void Undo(double* point) const;

  // Bytes that the constructor takes at most, and those of them that an object keeps.
  static double MemoryFor(const GridSize<Dimension>& target, int cellsANode);
  static double MemoryKept(const GridSize<Dimension>& target, int cellsANode);

private:
  void Step(const GradientField<Dimension>& moves, double* point) const;

  const CellDensity<Dimension>& Target;
  CellPlacement<Dimension> Placement;
  std::vector<GradientField<Dimension>> Moves; // one for each step, at the nodes
};

} // namespace RectifiedTransport

#endif
