// SPDX-License-Identifier: BSD-3-Clause
// The point at a corner of a triangle, where nobody has checked that there is one.
#ifndef RectifiedTransport_CornerPoint_h
#define RectifiedTransport_CornerPoint_h

#include "Core/Mesh/TriangleSurface.h"

#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

// Corner 3t+i is corner i of triangle t. Throws std::invalid_argument.
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

} // namespace RectifiedTransport

#endif
