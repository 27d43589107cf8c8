// SPDX-License-Identifier: BSD-3-Clause
// The distance of each point of a set to its nearest neighbour, by a tree of bounding boxes.
#ifndef RectifiedTransport_NearestNeighbours_h
#define RectifiedTransport_NearestNeighbours_h

#include "../Geometry/Points.h"
#include "../Parallel/Context.h"

namespace RectifiedTransport
{

// Writes the distance of each point to the nearest other one; infinite if there is none.
// Collective: each rank of the context gives its own points. It costs least if they lie near the
// points of few other ranks only. Boxes are divided at the median along their widest axis, so that
// clusters cost no more than spread points: O(count log count). Throws std::bad_alloc and
// Cancelled.
void nearestDistances(
  ConstPointSpan<3> points, double* distances, const Context& context = Context());

} // namespace RectifiedTransport

#endif
