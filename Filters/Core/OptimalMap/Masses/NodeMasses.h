// SPDX-License-Identifier: BSD-3-Clause
// What a density's mass is on a grid of nodes: exact integrals of the nodes' hat functions.
#ifndef RectifiedTransport_NodeMasses_h
#define RectifiedTransport_NodeMasses_h

#include "Core/Grid/NodeGrid.h"
#include "Core/OptimalMap/Masses/CellDensity.h"

namespace RectifiedTransport
{

class Progress;

// The sums below throw std::bad_alloc and Cancelled.

// Where the cells of a density are on a grid of nodes, whose box contains them.
template <int Dimension>
struct CellPlacement
{
  // Cells that fill the whole box.
  static CellPlacement Filling(
    const GridSize<Dimension>& cells, const GridSize<Dimension>& nodeCells)
  {
    CellPlacement placement;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      placement.Sides[axis] =
        static_cast<double>(nodeCells[axis]) / static_cast<double>(cells[axis]);
    }
    return placement;
  }

  // From index space to cells of the nodes, and back.
  Point<Dimension> ToNodes(const double* point) const
  {
    Point<Dimension> moved;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      moved[axis] = this->Low[axis] + this->Sides[axis] * point[axis];
    }
    return moved;
  }
  Point<Dimension> FromNodes(const double* point) const
  {
    Point<Dimension> moved;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      moved[axis] = (point[axis] - this->Low[axis]) / this->Sides[axis];
    }
    return moved;
  }

  Point<Dimension> Low{};   // low corner of the first cell, in cells of the nodes
  Point<Dimension> Sides{}; // sides of a cell, in cells of the nodes
};

// The masses of the nodes' hat functions, mu_i = integral of Lambda_i over the density, which sum
// to 1.
template <int Dimension>
NodeValues hatMasses(const CellDensity<Dimension>& density,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, Progress& progress);

// The same sums of any values of the cells of a grid of this size, which fill the box.
template <int Dimension>
NodeValues hatSums(const double* values, const GridSize<Dimension>& size,
  const NodeGrid<Dimension>& grid, Progress& progress);

// The masses of the cells between the nodes, times the number of these cells: 1 is the mean
// density.
template <int Dimension>
NodeValues cellMasses(const CellDensity<Dimension>& density,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, Progress& progress);

// The hat masses of a piecewise constant density that fills the box, given by its cells' masses, of
// mean 1, on a grid of this size; null: all are 1.
template <int Dimension>
NodeValues hatMasses(const double* cells, const GridSize<Dimension>& size,
  const NodeGrid<Dimension>& grid, Progress& progress);

// From such masses on a grid of this size to those between fewer nodes.
template <int Dimension>
NodeValues coarserCells(const double* cells, const GridSize<Dimension>& size,
  const NodeGrid<Dimension>& coarser, Progress& progress);

// The second moment of the lumped density less that of the density itself, in squared lengths:
// sum_i mu_i |x_i|^2 - M2.
template <int Dimension>
double lumpingExcess(const CellDensity<Dimension>& density,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, Progress& progress);

// The integral over a density of the multilinear interpolant of values at nodes: the sum of the
// products of these and hatMasses, which needs no memory for the nodes. The same bits for every
// number of threads. Throws std::bad_alloc and Cancelled.
template <int Dimension>
double integrateOver(const CellDensity<Dimension>& density,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, const double* values,
  Progress& progress);

} // namespace RectifiedTransport

#endif
