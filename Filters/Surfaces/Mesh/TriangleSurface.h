// SPDX-License-Identifier: BSD-3-Clause
// A non-owning view of a triangle surface.
#ifndef RectifiedTransport_TriangleSurface_h
#define RectifiedTransport_TriangleSurface_h

#include "../../Core/Geometry/Points.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

// Triangles are three indices of points each, from 0.
struct TriangleSurface
{
  ConstPointSpan<3> Points;
  const std::int64_t* Triangles;
  std::int64_t NumberOfTriangles;
};

// The point at a corner of a triangle, where nobody has checked that there is one: corner 3t+i is
// corner i of triangle t. Throws std::invalid_argument.
inline std::int64_t cornerPoint(const TriangleSurface& surface, std::int64_t corner)
{
  const std::int64_t point = surface.Triangles[corner];
  if (point < 0 || point >= surface.Points.size())
  {
    throw std::invalid_argument("triangle " + std::to_string(corner / 3) + " has the point " +
      std::to_string(point) + ", but there are " + std::to_string(surface.Points.size()) +
      " points");
  }
  return point;
}

// A triangle of the same three points as one before, in any order, and the first of these.
struct RepeatedTriangle
{
  std::int64_t Triangle;
  std::int64_t First;
};

// What was changed in a surface.
struct SurfaceRepairs
{
  std::int64_t UnusedPoints = 0;  // points of no triangle
  std::int64_t FlatTriangles = 0; // without area
  std::int64_t MergedPoints = 0;  // with others at their places
  std::int64_t Repeated = 0;      // triangles with the points of one before

  bool Any() const
  {
    return this->UnusedPoints + this->FlatTriangles + this->MergedPoints + this->Repeated > 0;
  }
};

} // namespace RectifiedTransport

#endif
