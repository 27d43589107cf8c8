// SPDX-License-Identifier: BSD-3-Clause
// The masses of triangles on a grid of the plane.
#ifndef RectifiedTransport_MassRaster_h
#define RectifiedTransport_MassRaster_h

#include "../../Core/Geometry/GridSize.h"
#include "../../Core/Geometry/Points.h"
#include "../../Core/Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

// Triangles of points in the unit square, with a mass each.
struct PlaneTriangles
{
  ConstPointSpan<2> Positions;   // in [0,1]^2
  const std::int64_t* Triangles; // three points each
  const double* Masses;          // one a triangle, in any unit
  std::int64_t NumberOfTriangles;
};

// Writes the mass of each cell of a grid on the unit square, axis 0 fastest. A triangle's mass,
// whatever its orientation, is spread evenly over it and divided among cells exactly. The mass of a
// triangle without area, or too thin for areas of parts, goes into the cell of its centre. Throws
// std::bad_alloc and Cancelled.
void rasterizeMass(const PlaneTriangles& triangles, const GridSize<2>& size, double* masses,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
