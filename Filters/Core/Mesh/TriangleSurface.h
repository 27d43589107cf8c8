// SPDX-License-Identifier: BSD-3-Clause
// A non-owning view of a triangle surface.
#ifndef RectifiedTransport_TriangleSurface_h
#define RectifiedTransport_TriangleSurface_h

#include "../Geometry/Points.h"

#include <cstdint>

namespace RectifiedTransport
{

// Triangles are three indices of points each, from 0.
struct TriangleSurface
{
  ConstPointSpan<3> Points;
  const std::int64_t* Triangles;
  std::int64_t NumberOfTriangles;
};

// A triangle of the same three points as one before, in any order, and the first of these.
struct RepeatedTriangle
{
  std::int64_t Triangle;
  std::int64_t First;
};

// What was changed in a surface.
struct SurfaceRepairs
{
  std::int64_t UnusedPoints = 0;  // of no triangle
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
