// SPDX-License-Identifier: BSD-3-Clause
// What is inside an odd number of closed rings, as triangles.
#ifndef RectifiedTransport_RingTriangles_h
#define RectifiedTransport_RingTriangles_h

#include "Core/Overlap/RingCrossings.h"

#include <array>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

struct RingTriangles
{
  // A point where edges cross that is none of the rings.
  struct AddedPoint
  {
    Point<2> Place;
    std::int64_t Edge; // the edge on which it lies
    double Part;       // share of the edge before it
  };

  // Points of the rings, and the added ones, numbered on from these. Counter-clockwise.
  std::vector<std::array<std::int32_t, 3>> Corners;
  std::vector<AddedPoint> Added;
};

// Rings may be concave, touch or cross themselves and others, go to a hole and back, lie in each
// other, and have points that coincide, of which one is taken. All points must be finite. Triangles
// fill the area to the rounding of coordinates, and none has no area. In O(n log n) for n edges and
// crossings. Incomplete if `progress` is cancelled.
RingTriangles triangulateRings(const Rings& rings, Progress& progress);

} // namespace RectifiedTransport

#endif
