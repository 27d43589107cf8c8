// SPDX-License-Identifier: BSD-3-Clause
// The radius with which points are shown as discs or spheres.
#ifndef RectifiedTransport_DotRadius_h
#define RectifiedTransport_DotRadius_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"

namespace RectifiedTransport
{

// One for all: half the distance of neighbours where the points are dense, so that dots of equal
// mass touch there, and their area shows the density. 0 without two points at different places.
// Collective. Throws Cancelled and std::bad_alloc.
double radiusOfDots(ConstPointSpan<3> points, const Context& context);

} // namespace RectifiedTransport

#endif
