// SPDX-License-Identifier: BSD-3-Clause
// Conservative resampling of meshes to grids: integrals of linear functions on simplices, and of
// multilinear functions on boxes, over the cells of a grid.
#ifndef RectifiedTransport_Overlap_h
#define RectifiedTransport_Overlap_h

#include "../Geometry/GridSize.h"
#include "../Geometry/Points.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{

// In index space, where grid cell (i0, i1, i2) is [i0, i0+1] x ...; vertices may be beyond the
// grid.
template <int Dimension>
struct LinearSimplex
{
  std::array<Point<Dimension>, Dimension + 1> Vertices;
  std::array<double, Dimension + 1> Values; // at the vertices
};

template <int Dimension>
struct MultilinearBox
{
  Point<Dimension> Low;
  Point<Dimension> High;
  std::array<double, std::size_t{ 1 } << Dimension> Values; // at the corners, axis 0 fastest
};

// Grid cells [First, Last) along the last axis: the part of the grid that one thread adds to. What
// it adds does not depend on where the slab begins and ends.
template <int Dimension>
struct GridSlab
{
  GridSize<Dimension> Size;
  std::int64_t First;
  std::int64_t Last;
  double* Sums; // by grid cells, axis 0 fastest
};

// The length, area or volume of a simplex, in grid cells.
template <int Dimension>
double measureOf(const LinearSimplex<Dimension>& simplex);

// Adds to each grid cell of the slab the integral over the intersection of the cell and the
// simplex. It and the sum over all cells are exact to rounding.
template <int Dimension>
void addOverlaps(const LinearSimplex<Dimension>& simplex, const GridSlab<Dimension>& slab);

// The same for a box.
template <int Dimension>
void addOverlaps(const MultilinearBox<Dimension>& box, const GridSlab<Dimension>& slab);

} // namespace RectifiedTransport

#endif
