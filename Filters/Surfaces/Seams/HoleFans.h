// SPDX-License-Identifier: BSD-3-Clause
// Triangles that close the holes of a component which has many.
#ifndef RectifiedTransport_HoleFans_h
#define RectifiedTransport_HoleFans_h

#include "Surfaces/Seams/SeamMesh.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Seams between many holes leave corridors, which no map to a square keeps even: a conformal one
// squeezes them by e^(pi length / width). Such holes are closed instead, and get nearly no area.
struct HoleFans
{
  // Their share of the area of the square.
  static constexpr double AreaShare = 0.02;

  std::vector<Point<3>> Points;        // a point each, numbered after those of the component
  std::vector<std::int64_t> Triangles; // three points each: a fan about the hole's point
  std::vector<std::int64_t> Origins;   // by triangles: all different, below 0, as seams may cross
};

// Closes all holes of a component with more than 8 that are not long beside it. Otherwise empty.
// The point is off the hole's middle, so that each triangle has an area. O(sides). Throws
// std::bad_alloc and Cancelled.
HoleFans closeManyHoles(const SeamMesh& mesh, Progress& progress);

} // namespace RectifiedTransport

#endif
