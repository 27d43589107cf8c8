// SPDX-License-Identifier: BSD-3-Clause
// What a map leaves where it is: parts of the target that the source has as well, cell by cell.
#ifndef RectifiedTransport_FixedCells_h
#define RectifiedTransport_FixedCells_h

#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/PotentialSolver.h"

namespace RectifiedTransport
{

class Progress;

// A cell between nodes may stand still if both densities have the same mass there and a node about
// it is next to its own image: there the two potentials sum to 0, the most that they may. A
// connected part of such cells stands still if the gradient of the potential says no more than its
// errors, a fraction of a cell, and if little mass would cross its border to other cells with mass.
// The optimal map is the identity there. Points go nowhere, whatever the errors of the potentials
// and whatever corrects the masses of samples.
template <int Dimension>
class FixedCells
{
public:
  // Under the map from a side of a solver to the other one, whose density is the target. The same
  // bits for every number of threads. Throws std::bad_alloc and Cancelled.
  FixedCells(const PotentialSolver<Dimension>& solver, int from,
    const CellDensity<Dimension>& target, Progress& progress);

  bool AreNone() const { return !this->All && this->AreFixed.size() == 0; }
  // Whether all of the target's mass stands still; then all points do.
  bool AreAll() const { return this->All; }
  // Whether a point of the source's index space stands still; then it becomes its image.
  bool Fix(double* point) const;
  // The same back from the target's index space.
  bool FixBackward(double* image) const;
  // Finds the points that stand still among those of the source's index space, given one after the
  // other, and writes their images again.
  void RestoreFixed(const double* points, PointSpan<Dimension> images) const;

  // Bytes that an object keeps at most, and those that it takes besides while it is made.
  static double MemoryKept(const GridSize<Dimension>& target);
  static double MemoryFor(const GridSize<Dimension>& nodes);

private:
  // Whether a point stands still; then it becomes its place in the index space `to`.
  bool MapIfFixed(const CellPlacement<Dimension>& from, const CellPlacement<Dimension>& to,
    const GridSize<Dimension>& size, double* point) const;
  // Whether the target cell at an image stands still.
  bool IsFixedAt(const double* image) const;

  const GridSize<Dimension> SourceSize;
  const GridSize<Dimension> Size; // cells of the target
  const CellPlacement<Dimension> SourcePlacement;
  const CellPlacement<Dimension> TargetPlacement;
  bool All = false;
  LargeBuffer<unsigned char> AreFixed; // the target's cells; empty for none or all
};

} // namespace RectifiedTransport

#endif
