// SPDX-License-Identifier: BSD-3-Clause
// Regions of a plane from closed rings by the even-odd rule. Rings may be concave, touch or cross
// themselves and others, go to a hole and back, or lie in each other.
#ifndef RectifiedTransport_RegionOutlines_h
#define RectifiedTransport_RegionOutlines_h

#include "Core/Overlap/RingCrossings.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// A piece of an edge, with the region on the left.
struct OutlineEdge
{
  Point<2> From;
  Point<2> To;
  std::int32_t Edge; // number of the edge among those of the rings
  std::int32_t Ring; // the ring whose region this is
};

// What is inside an odd number of the rings. A place belongs to the region of one of the rings
// around it: the smallest of those whose value occurs an odd number of times among them. Thus rings
// in a ring are holes, and rings in holes are islands with their own value. If a hole of a region
// and a region in it have the same ring, the place belongs to the latter.
//
// The edges are in the order of the regions; each region is on the left of its edges once. The time
// is that of findCrossings. Incomplete if `progress` is cancelled.
//
// `areSimple`: whether it is known that no edges cross, before and after the call; it is not
// checked for few edges.
std::vector<OutlineEdge> regionOutlines(const Rings& rings, const std::vector<double>& values,
  Progress& progress, bool* areSimple = nullptr);

// The area of a region given by its edges, and its centroid if the area is not 0.
struct RegionSize
{
  double Area = 0.0;
  Point<2> Centroid{ 0.0, 0.0 };
};
RegionSize sizeOfRegion(const OutlineEdge* first, const OutlineEdge* last);

// The area that a ring winds around, of either sign.
double windingArea(const Rings& rings, std::int64_t ring);

} // namespace RectifiedTransport

#endif
