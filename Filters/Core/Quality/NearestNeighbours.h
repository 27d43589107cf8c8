// SPDX-License-Identifier: BSD-3-Clause
// How far each point of a set is from the nearest other one.
#ifndef RectifiedTransport_NearestNeighbours_h
#define RectifiedTransport_NearestNeighbours_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

// Writes the distance of each point from the nearest other one: infinite if there is no other. A
// tree of boxes, halved along their widest axis, so that clusters cost no more than spread points;
// O(count log count). Throws std::bad_alloc and Cancelled.
void nearestDistances(
  ConstPointSpan<3> points, double* distances, const Context& context = Context());

} // namespace RectifiedTransport

#endif
