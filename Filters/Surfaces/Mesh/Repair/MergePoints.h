// SPDX-License-Identifier: BSD-3-Clause
// Finds points with nearly the same coordinates, and triangles with the same points.
#ifndef RectifiedTransport_MergePoints_h
#define RectifiedTransport_MergePoints_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Writes for each point the index of the point that represents its cluster: the one with the lowest
// coordinates, by x, then y, then z, for any order of the points. Points that differ by less than
// `distance`, above 0, along every axis are in one cluster. Points that differ by three times as
// much along an axis are not, unless others lie between them. Uses a hash table of boxes, in linear
// time for any distribution, too. Returns whether points of different coordinates are merged.
// Memory: up to 72 bytes a point. On one thread. Throws std::bad_alloc and Cancelled.
bool mergeNearPoints(ConstPointSpan<3> points, double distance, std::int64_t* firsts,
  const Context& context = Context());

// All triangles with the three different points of one before, in any order; they ascend. Memory:
// 10 bytes a triangle, 8 a point. On one thread. Throws std::bad_alloc and Cancelled.
std::vector<RepeatedTriangle> findRepeatedTriangles(
  const TriangleSurface& surface, const Context& context = Context());

} // namespace RectifiedTransport

#endif
