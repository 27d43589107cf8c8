// SPDX-License-Identifier: BSD-3-Clause
// A short way through dots, for plotters, which lift their pen from one to the next.
#ifndef RectifiedTransport_DotPath_h
#define RectifiedTransport_DotPath_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The order of points in a plane along a short path: a Hilbert curve, improved by exchanges of two
// edges and by moves of up to three points, both among the eight nearest neighbours of each point.
// Lengths are a few per cent above the least. Equal points stay in their order. O(n log n) but for
// few long exchanges; 100 bytes a point. On one thread. Throws std::bad_alloc and Cancelled.
std::vector<std::int64_t> shortPath(ConstPointSpan<2> points, const Context& context = Context());

} // namespace RectifiedTransport

#endif
