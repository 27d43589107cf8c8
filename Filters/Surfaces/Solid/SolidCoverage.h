// SPDX-License-Identifier: BSD-3-Clause
// The fraction of each grid cell that a closed surface encloses: the density of a solid (paper,
// Section 5.2).
#ifndef RectifiedTransport_SolidCoverage_h
#define RectifiedTransport_SolidCoverage_h

#include "../../Core/Geometry/GridSize.h"
#include "../../Core/Geometry/LatticePart.h"
#include "../../Core/Geometry/Points.h"
#include "../../Core/Parallel/Context.h"
#include "../Mesh/TriangleSurface.h"

#include <cstdint>

namespace RectifiedTransport
{

// Triangles of a closed surface and, if known, the number of each triangle's body; else bodies are
// triangles joined by points.
struct SolidSurface
{
  SolidSurface(const TriangleSurface& triangles, const std::int64_t* bodies = nullptr) // NOLINT
    : Triangles(triangles)
    , Bodies(bodies)
  {
  }

  TriangleSurface Triangles;
  const std::int64_t* Bodies;
};

struct CoverageReport
{
  // Lines that do not leave the solid as often as they enter it; none if every edge has two
  // triangles of opposite directions along it, as in an oriented ClosedMesh.
  std::int64_t OpenLines = 0;
};

// Writes the covered fraction of every grid cell, from 0 to 1, axis 0 fastest. The points are in
// index space: cell (i, j, k) covers [i, i+1] x [j, j+1] x [k, k+1]. The solid is where the winding
// number is not zero: overlapping parts are united, and a shell of opposite orientation inside
// another is a cavity. Parts of the surface outside the grid are ignored along axes 1 and 2 and
// projected onto its border along axis 0.
//
// Cells are exact to rounding, however thin the parts of the solid in them, if bodies lie beside or
// within each other: the volume within a cell is a sum over the triangles' pieces in the row of
// cells. If bodies intersect each other or themselves, the sum counts some places more than once.
// These are found on supersampling^2 lines along axis 0 through each cell, at the centres of as
// many equal squares: such a cell gets the share of its sum that the lines cover. Values that
// differ from 0 or 1 by at most the rounding of coordinates, about 2e-15 times the number of cells
// along the longest axis and the area of the surface in the cell and before it, become 0 or 1.
//
// The same bits on any number of threads, for any order of the triangles, and for any part of the
// grid. O(cells + pieces of triangles in cells + crossings of lines). Memory: 8 bytes for each
// layer of grid cells that a triangle crosses; for each thread 32 bytes for each cell of a layer,
// and 16 for each of its crossings; 9 bytes a triangle and 8 a point. Throws std::bad_alloc and
// Cancelled.
CoverageReport coverSolid(const SolidSurface& surface, const GridSize<3>& cells, int supersampling,
  double* coverage, const Context& context = Context());

// The same for a part of the grid, with the same bits; only lines that meet the part are counted.
CoverageReport coverPartOfSolid(const SolidSurface& surface, const GridSize<3>& cells,
  const LatticePart<3>& part, int supersampling, double* coverage,
  const Context& context = Context());

// The same for triangles that leave holes: inside is where their generalized winding number (see
// WindingTree.h) is a half or more. Values are those of the lines, supersampling^2 a cell: exact
// lengths along axis 0. The triangles face outwards, as those of an oriented surface do.
void coverPartOfOpenSolid(const TriangleSurface& surface, const GridSize<3>& cells,
  const LatticePart<3>& part, int supersampling, double* coverage,
  const Context& context = Context());

// Points that are distributed like a coverage are spread evenly in cells that are covered in part.
// Moves those outside of the surface to another place in their cell that is inside. Where less than
// about a thousandth of a cell is covered, some may stay. Triangles and points are in index space.
// O((triangles + points) log triangles). Throws std::bad_alloc and Cancelled.
void moveInside(
  const TriangleSurface& surface, PointSpan<3> points, const Context& context = Context());

} // namespace RectifiedTransport

#endif
