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

} // namespace RectifiedTransport

#endif
