// SPDX-License-Identifier: BSD-3-Clause
// Removes triangles without area from a surface, and keeps its connectivity.
#ifndef RectifiedTransport_DegenerateTriangles_h
#define RectifiedTransport_DegenerateTriangles_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

// Triangles that are changed in place. Each has three different points, three corners, which are
// labels of the points, and the origin that it is part of.
struct EditedTriangles
{
  ConstPointSpan<3> Positions;
  std::int64_t* Points;  // three a triangle
  std::int64_t* Corners; // three a triangle
  std::int64_t* Origins; // one a triangle
  std::int64_t Count;
};

// Removes the triangles whose height is at most `height`. The third point of such a triangle is
// between the ends of its longest side. On the boundary the triangle is left out, because the other
// two sides are the same line. Elsewhere the side is flipped: the triangle beyond it is cut in two
// at that point, and both parts have its origin. Triangles that cannot be removed without joining
// edges stay.
//
// Writes -1 for the points of removed triangles. For each point of a triangle that was left out,
// writes the nearest other point of it to `nearest`, which is indexed by points. The triangles must
// be oriented; those that disagree with their neighbour stay. O(triangles), and for each flip the
// triangles about a point. Memory: 40 bytes a triangle, and that of SurfaceEdges. Throws
// std::bad_alloc and Cancelled.
void removeDegenerateTriangles(const EditedTriangles& triangles, double height,
  std::int64_t* nearest, const Context& context = Context());

} // namespace RectifiedTransport

#endif
