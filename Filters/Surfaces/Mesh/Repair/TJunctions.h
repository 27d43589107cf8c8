// SPDX-License-Identifier: BSD-3-Clause
// T-junctions: points that lie within an edge of another triangle, as where the triangles on one
// side of a line are half as large as those on the other side.
//
//   const std::vector<TJunction> junctions = findTJunctions(points, openSides, tolerance,
//   progress); const SplitSurface closed(surface, junctions, progress);
#ifndef RectifiedTransport_TJunctions_h
#define RectifiedTransport_TJunctions_h

#include "Core/Geometry/Points.h"
#include "Surfaces/Mesh/SurfaceEdges.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// A side (see SurfaceEdges.h) that no other triangle has. Its points are merged: those at one place
// have one number.
struct OpenSide
{
  std::int64_t Side;
  std::int64_t From;
  std::int64_t To;
  std::int64_t Opposite; // the third point of its triangle
};

// Where a side has a point of other triangles.
struct TJunction
{
  std::int64_t Side;
  std::int64_t Point;
  double Place; // from 0 to 1 along the side
};

// What rounding leaves of the differences of coordinates at one place; that of float if the
// coordinates of all triangles are floats, else that of double. Throws Cancelled.
double roundingOfCorners(const TriangleSurface& surface, Progress& progress);
// The same for all points, also those of no triangle.
double roundingOfPoints(ConstPointSpan<3> points);

// How sides of a surface are compared.
struct SideOptions
{
  const std::int64_t* Merged = nullptr;     // the point that a point is merged with; null: none is
  const unsigned char* IsLeftOut = nullptr; // by triangles; null: none is
};

// The open sides of a surface, in their order. Triangles with a point twice have no sides. O(sides
// log sides). Memory: 27 bytes a triangle and 8 a point.
std::vector<OpenSide> openSidesOf(
  const TriangleSurface& surface, const SideOptions& options, Progress& progress);

// The ends of open sides that lie on other open sides. They may be off by `rounding`, or by that of
// double, or by 1e-6 of the longest side of the bounds of all ends. Cut there, the side must have a
// part that is a side, or part of a side, of another triangle: a triangle that only touches an edge
// makes no T-junction. They are sorted by sides and places.
//
// O(sides log sides), besides the points that are found. Memory: 250 bytes a side. On one thread.
// Throws std::bad_alloc and Cancelled.
std::vector<TJunction> findTJunctions(ConstPointSpan<3> points,
  const std::vector<OpenSide>& openSides, double rounding, Progress& progress);

} // namespace RectifiedTransport

#endif
