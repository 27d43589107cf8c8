// SPDX-License-Identifier: BSD-3-Clause
// The nodes at the corners of a lattice of equal cells that fills a box: what potentials are given
// at.
#ifndef RectifiedTransport_NodeGrid_h
#define RectifiedTransport_NodeGrid_h

#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/LargeBuffer.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// One value a node, axis 0 fastest.
using NodeValues = LargeBuffer<double>;

template <int Dimension>
struct NodeGrid
{
  GridSize<Dimension> Cells;  // along each axis an even number, at least 2
  Point<Dimension> Spacing{}; // distances of nodes, in lengths; the box is [0, Cells * Spacing]

  // The lattice of `cells` over the box [0, lengths].
  static NodeGrid In(const GridSize<Dimension>& cells, const Point<Dimension>& lengths)
  {
    NodeGrid grid{ cells, {} };
    for (int axis = 0; axis < Dimension; ++axis)
    {
      grid.Spacing[axis] = lengths[axis] / static_cast<double>(cells[axis]);
    }
    return grid;
  }

  std::int64_t NumberOfCells() const
  {
    return static_cast<std::int64_t>(numberOfCells<Dimension>(this->Cells));
  }
  std::int64_t NumberOfNodes() const { return this->Stride(Dimension); }
  // The difference of the numbers of two neighbours along an axis.
  std::int64_t Stride(int axis) const
  {
    std::int64_t stride = 1;
    for (int a = 0; a < axis; ++a)
    {
      stride *= this->Cells[a] + 1;
    }
    return stride;
  }
  // The sum of the box's squared sides, in squared lengths.
  double SquaredDiagonal() const
  {
    double sum = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double side = static_cast<double>(this->Cells[axis]) * this->Spacing[axis];
      sum += side * side;
    }
    return sum;
  }
};

// The lines of nodes along an axis, which are numbered like the nodes of the grid without the axis.
struct NodeLines
{
  template <int Dimension>
  NodeLines(const NodeGrid<Dimension>& grid, int axis)
    : Nodes(grid.Cells[axis] + 1)
    , Stride(grid.Stride(axis))
    , Count(grid.NumberOfNodes() / this->Nodes)
  {
  }
  // The first node of a line.
  std::int64_t Begin(std::int64_t line) const
  {
    return line / this->Stride * this->Stride * this->Nodes + line % this->Stride;
  }

  std::int64_t Nodes;  // nodes of a line
  std::int64_t Stride; // distance in memory of neighbours on a line
  std::int64_t Count;  // number of lines
};

// The cell that holds a point, whose coordinates are in cells, and the place in it, from 0 to 1.
template <int Dimension>
struct CellPlace
{
  CellPlace(const double* point, const GridSize<Dimension>& cells)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto last = static_cast<double>(cells[axis] - 1);
      this->Cell[axis] = static_cast<std::int64_t>(std::clamp(point[axis], 0.0, last));
      this->Place[axis] = point[axis] - static_cast<double>(this->Cell[axis]);
    }
  }

  GridSize<Dimension> Cell;
  Point<Dimension> Place;
};

// The 2^Dimension nodes about a point of the box, given in cells of the nodes, and the values of
// their hat functions there, which sum to 1.
template <int Dimension>
struct HatWeights
{
  static constexpr int Count = 1 << Dimension;

  HatWeights(const double* point, const GridSize<Dimension>& cells)
  {
    const CellPlace<Dimension> at(point, cells);
    this->Node[0] = 0;
    this->Weight[0] = 1.0;
    std::int64_t stride = 1;
    int corners = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double high = at.Place[axis];
      for (int corner = 0; corner < corners; ++corner)
      {
        this->Node[corner] += at.Cell[axis] * stride;
        this->Node[corners + corner] = this->Node[corner] + stride;
        this->Weight[corners + corner] = this->Weight[corner] * high;
        this->Weight[corner] *= 1.0 - high;
      }
      stride *= cells[axis] + 1;
      corners *= 2;
    }
  }

  // The multilinear interpolant of values at nodes.
  double Interpolate(const double* values) const
  {
    double sum = 0.0;
    for (int corner = 0; corner < Count; ++corner)
    {
      sum += this->Weight[corner] * values[this->Node[corner]];
    }
    return sum;
  }

  std::int64_t Node[Count];
  double Weight[Count];
};

} // namespace RectifiedTransport

#endif
