// SPDX-License-Identifier: BSD-3-Clause
// Moves sites apart that lie at one point, or nearly: a power diagram cannot tell them apart.
#ifndef RectifiedTransport_SeparateSites_h
#define RectifiedTransport_SeparateSites_h

#include "Core/Geometry/Points.h"

#include <limits>

namespace RectifiedTransport
{

class Progress;

// All of the plane, if not set.
struct SiteBounds
{
  Point<2> Low = { -std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  Point<2> High = { std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() };
};

// At less, in units of the mean spacing of sites of equal masses, the bisector of two has too few
// digits.
constexpr double leastSiteDistance = 1e-5;

// The first of sites that are nearer than `distance` to each other stays; the others move aside, to
// places in `bounds`, on a spiral about where they were (in thin bounds on a line), that are as far
// from every other site. The same for the same sites in the same order. As the work of the current
// stage. Throws std::bad_alloc and Cancelled.
void separateSites(
  PointSpan<2> sites, double distance, const SiteBounds& bounds, Progress& progress);

} // namespace RectifiedTransport

#endif
