// SPDX-License-Identifier: BSD-3-Clause
// Moves (nearly) coincident sites apart: a power diagram cannot tell them apart.
#ifndef RectifiedTransport_SeparateSites_h
#define RectifiedTransport_SeparateSites_h

#include "Core/Geometry/Points.h"

#include <limits>

namespace RectifiedTransport
{

class Progress;

// The whole plane by default.
struct SiteBounds
{
  Point<2> Low = { -std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  Point<2> High = { std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() };
};

// In units of the mean spacing of sites of equal masses. Below it, the bisector of two sites has
// too few digits.
constexpr double leastSiteDistance = 1e-5;

// If sites are nearer than `distance` to each other, the first stays. The others move to places in
// `bounds` that are at least as far from every other site, on a spiral about their old places (in
// thin bounds on a line). The result depends only on the sites and their order. Throws
// std::bad_alloc and Cancelled.
void separateSites(
  PointSpan<2> sites, double distance, const SiteBounds& bounds, Progress& progress);

} // namespace RectifiedTransport

#endif
