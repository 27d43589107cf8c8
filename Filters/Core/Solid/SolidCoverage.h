// SPDX-License-Identifier: BSD-3-Clause
// The fraction of each grid cell that a closed surface encloses, by scan lines: the density of a
// solid (paper, Section 5.2).
#ifndef RectifiedTransport_SolidCoverage_h
#define RectifiedTransport_SolidCoverage_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Mesh/TriangleSurface.h"
#include "Core/Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

struct CoverageReport
{
  // Lines that leave the solid another number of times than they enter it; none if every edge has
  // two triangles of opposite directions along it, as in an oriented ClosedMesh.
  std::int64_t OpenLines = 0;
};

// Writes the covered fraction of every grid cell, from 0 to 1, axis 0 fastest. The points are in
// index space: cell (i, j, k) covers [i, i+1] x [j, j+1] x [k, k+1]. The solid is where the winding
// number is not zero: overlapping parts are united, and a shell of opposite orientation inside
// another is a cavity. Parts of the surface outside of the grid are ignored along axes 1 and 2 and
// projected onto its border along axis 0.
//
// Each grid cell is crossed by supersampling^2 lines along axis 0, through the centres of as many
// equal squares. The length that a line covers is exact, so that only the other two axes are
// sampled. A surface that passes exactly through lines and rows of lines is no special case: the
// plane of a row intersects the surface in closed polygons, whose corners are on the triangles'
// edges, at places that both triangles of an edge compute from the same numbers in the same order.
// Such a polygon crosses every line of the row equally often in both directions, if a corner on the
// line counts as below it, whatever the rounding of the corners.
//
// O(cells + triangles x rows of lines that they cross + crossings of lines). Memory: 8 bytes for
// each layer of grid cells that a triangle intersects, and a layer's crossings, 16 bytes each, for
// each thread. Throws std::bad_alloc and Cancelled.
CoverageReport coverSolid(const TriangleSurface& surface, const GridSize<3>& cells,
  int supersampling, double* coverage, const Context& context = Context());

// Of a part of the grid, with the same bits; lines that meet the part alone are counted.
CoverageReport coverPartOfSolid(const TriangleSurface& surface, const GridSize<3>& cells,
  const LatticePart<3>& part, int supersampling, double* coverage,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
