// SPDX-License-Identifier: BSD-3-Clause
// Regions of a plane whose outlines are closed rings: what the even-odd rule makes of rings that
// are concave, touch or cross themselves and others, go to a hole and back, or lie in each other.
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
  std::int32_t Edge; // of the rings
  std::int32_t Ring; // the region's
};

// What is inside of an odd number of the rings. A place belongs to the region of one of the rings
// around it: the smallest of those whose value is there on an odd number of them. So rings in a
// ring are holes, and rings in these are islands with a value of their own; and two rings that are
// the same, the hole of a region and the region in it, leave it to the latter.
//
// The edges are in the order of the regions; each region is to the left of its own once. The time
// is that of findCrossings. Incomplete where `progress` says to stop.
//
// `areSimple` says whether it is known that no edges cross, and becomes whether it is now; that is
// not looked into for few edges.
std::vector<OutlineEdge> regionOutlines(const Rings& rings, const std::vector<double>& values,
  Progress& progress, bool* areSimple = nullptr);

// Of edges that bound a region: its area, and its centroid where that is not 0.
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
