// SPDX-License-Identifier: BSD-3-Clause
// How far each point of a set is from the nearest other one.
#ifndef RectifiedTransport_NearestNeighbours_h
#define RectifiedTransport_NearestNeighbours_h

#include "Core/Parallel/Executor.h"

#include <cstdint>

namespace RectifiedTransport
{

// Writes the distance of each of `count` points, 3 coordinates each, from the nearest other one:
// infinite if there is no other. A tree of boxes, halved along their widest axis, so that clusters
// cost no more than spread points; O(count log count). Returns false if the monitor cancelled.
// Throws std::bad_alloc.
bool nearestDistances(const double* points, std::int64_t count, double* distances,
  const Executor& executor, const Monitor& monitor);

} // namespace RectifiedTransport

#endif
