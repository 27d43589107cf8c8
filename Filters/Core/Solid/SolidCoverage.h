// SPDX-License-Identifier: BSD-3-Clause
// How much of each cell of a grid a closed surface encloses, by scan lines.
#ifndef RectifiedTransport_SolidCoverage_h
#define RectifiedTransport_SolidCoverage_h

#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/Context.h"
#include "Core/Solid/TriangleSurface.h"

#include <cstdint>

namespace RectifiedTransport
{

struct CoverageReport
{
  // Lines that leave the solid another number of times than they enter it; none if every edge has
  // two triangles that run along it in opposite directions.
  std::int64_t OpenLines = 0;
};

// Writes the covered fraction of every cell, from 0 to 1, axis 0 fastest. The points are in cells
// of the grid: cell (i, j, k) covers [i, i+1] x [j, j+1] x [k, k+1]. The solid is where the winding
// number is not zero: overlapping parts are united, and a shell inside of another that is turned
// the other way is a cavity. What lies outside of the grid counts for nothing along axes 1 and 2
// and for its border along axis 0.
//
// Each cell is crossed by supersampling^2 lines along axis 0, through the centres of as many equal
// squares. What a line covers of the cell is exact, so that only the other two axes are sampled.
// A surface that passes through lines and rows of lines exactly is no special case: the plane of a
// row cuts the surface in closed polygons, whose corners are on the triangles' edges, at places
// that both triangles of an edge compute from the same numbers in the same order. Such a polygon
// crosses every line of the row as often one way as the other, if a corner on the line counts as
// below it, whatever rounding did to the corners.
//
// O(cells + triangles x rows of lines that they cross + crossings of lines). Memory: 8 bytes for
// each layer of cells that a triangle has a part in, and a layer's crossings, 16 bytes each, for
// each thread. Throws std::bad_alloc and Cancelled.
CoverageReport coverSolid(const TriangleSurface& surface, const GridSize<3>& cells,
  int supersampling, double* coverage, const Context& context = Context());

} // namespace RectifiedTransport

#endif
