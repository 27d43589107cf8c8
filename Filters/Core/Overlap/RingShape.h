// SPDX-License-Identifier: BSD-3-Clause
// What the points of a ring in space are like, from the first one, which is not again at the end.
#ifndef RectifiedTransport_RingShape_h
#define RectifiedTransport_RingShape_h

#include "Core/Geometry/Vectors.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

// Whether the points are not all on a line: the cross product with the longest offset exceeds
// rounding.
inline bool hasArea(const std::vector<Point<3>>& ring)
{
  Point<3> longest{ 0.0, 0.0, 0.0 };
  for (const Point<3>& place : ring)
  {
    const Point<3> offset = place - ring.front();
    longest = lengthOf(offset) > lengthOf(longest) ? offset : longest;
  }
  constexpr double rounding = 1e-14;
  const double least = rounding * dot(longest, longest);
  return std::any_of(ring.begin(), ring.end(),
    [&](const Point<3>& place) { return lengthOf(cross(longest, place - ring.front())) > least; });
}

// A quick test for rings of few points, as most have; false for others.
inline bool isConvex(const std::vector<Point<3>>& ring)
{
  constexpr std::size_t most = 4; // more may turn around twice
  const std::size_t count = ring.size();
  Point<3> first{ 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < count && count <= most; ++i)
  {
    const Point<3>& corner = ring[(i + 1) % count];
    const Point<3> turn = cross(corner - ring[i], ring[(i + 2) % count] - corner);
    first = i == 0 ? turn : first;
    if (dot(first, turn) < 0.0)
    {
      return false;
    }
  }
  return count <= most;
}

} // namespace RectifiedTransport

#endif
