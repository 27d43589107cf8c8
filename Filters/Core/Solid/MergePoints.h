// SPDX-License-Identifier: BSD-3-Clause
// Which points have the same coordinates.
#ifndef RectifiedTransport_MergePoints_h
#define RectifiedTransport_MergePoints_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

// Writes for each point, whose coordinates are finite, the first one that has the same. A table of
// the coordinates' bits, so that the time is linear however the points lie: lists of the points in
// the boxes of a grid take the square of it where most points are in one box. Memory: up to 32
// bytes a point. On one thread. Throws std::bad_alloc and Cancelled.
void mergePoints(
  ConstPointSpan<3> points, std::int64_t* firsts, const Context& context = Context());

} // namespace RectifiedTransport

#endif
