// SPDX-License-Identifier: BSD-3-Clause
// The size of a grid of cells.
#ifndef RectifiedTransport_GridSize_h
#define RectifiedTransport_GridSize_h

#include "Points.h"

#include <array>
#include <cstdint>

// In a source: the instantiations of a template of the dimension for all dimensions. A function
// must not be overloaded.
#define RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(name)                                                 \
  template class name<1>;                                                                          \
  template class name<2>;                                                                          \
  template class name<3>
#define RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(name)                                              \
  template decltype(name<1>) name<1>;                                                              \
  template decltype(name<2>) name<2>;                                                              \
  template decltype(name<3>) name<3>

namespace RectifiedTransport
{

constexpr int MaximumResolution = 1 << 30; // cells along an axis, so that ints hold extents

// Cells along each axis.
template <int Dimension>
using GridSize = std::array<std::int64_t, Dimension>;

// The centre of a cell of unit sides, relative to the cell.
template <int Dimension>
Point<Dimension> cellCentre()
{
  Point<Dimension> centre;
  centre.fill(0.5);
  return centre;
}

// A double: requested sizes may have more cells than an integer holds.
template <int Dimension>
double numberOfCells(const GridSize<Dimension>& size)
{
  double count = 1.0;
  for (const std::int64_t cells : size)
  {
    count *= static_cast<double>(cells);
  }
  return count;
}

// The corners of the cells: one more along each axis.
template <int Dimension>
double numberOfCorners(GridSize<Dimension> cells)
{
  for (std::int64_t& side : cells)
  {
    ++side;
  }
  return numberOfCells<Dimension>(cells);
}

// The number, axis 0 fastest, of the cell that holds a point in index space or is nearest to it.
template <int Dimension>
std::int64_t numberOfCellAt(const double* point, const GridSize<Dimension>& size)
{
  std::int64_t number = 0;
  for (int axis = Dimension; axis-- > 0;)
  {
    const auto last = static_cast<double>(size[axis] - 1);
    // number = i_0 + size_0 (i_1 + size_1 i_2).
    number = number * size[axis] + static_cast<std::int64_t>(std::clamp(point[axis], 0.0, last));
  }
  return number;
}

// The sides of a cell of a lattice that fills the box [0, size].
template <int Dimension>
Point<Dimension> latticeStep(const GridSize<Dimension>& lattice, const GridSize<Dimension>& size)
{
  Point<Dimension> step;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    step[axis] = static_cast<double>(size[axis]) / static_cast<double>(lattice[axis]);
  }
  return step;
}

} // namespace RectifiedTransport

#endif
