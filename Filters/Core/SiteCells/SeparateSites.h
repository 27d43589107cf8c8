// SPDX-License-Identifier: BSD-3-Clause
// Moves sites apart that lie at one point, or nearly: a power diagram cannot tell them apart.
#ifndef RectifiedTransport_SeparateSites_h
#define RectifiedTransport_SeparateSites_h

#include "Core/Geometry/Points.h"

namespace RectifiedTransport
{

class Progress;

// The first of sites that are nearer than `distance` to each other stays; the others move aside, to
// places on a spiral about where they were that are as far from every other site. The same for the
// same sites in the same order. As the work of the current stage. Throws std::bad_alloc and
// Cancelled.
void separateSites(PointSpan<2> sites, double distance, Progress& progress);

} // namespace RectifiedTransport

#endif
