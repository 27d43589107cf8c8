// SPDX-License-Identifier: BSD-3-Clause
// Finds points with the same coordinates.
#ifndef RectifiedTransport_MergePoints_h
#define RectifiedTransport_MergePoints_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

// Writes for each point the index of the first one with the same, finite, coordinates. Uses a hash
// table of the coordinates' bits: linear time for any distribution of the points, where the bins of
// a point locator take quadratic time if most points are in one bin. Memory: up to 32 bytes a
// point. On one thread. Throws std::bad_alloc and Cancelled.
void mergePoints(
  ConstPointSpan<3> points, std::int64_t* firsts, const Context& context = Context());

} // namespace RectifiedTransport

#endif
