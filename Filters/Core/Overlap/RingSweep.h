// SPDX-License-Identifier: BSD-3-Clause
// Whether edges of rings cross at all, which those of most do not.
#ifndef RectifiedTransport_RingSweep_h
#define RectifiedTransport_RingSweep_h

#include "Core/Overlap/RingCrossings.h"

namespace RectifiedTransport
{

class Progress;

// In O(n log n) whatever the rings are, by a line that sweeps the plane upwards (Shamos and Hoey
// 1976). Touching edges are as in findCrossings. Undefined where `progress` says to stop.
bool haveCrossings(const Rings& rings, Progress& progress);

} // namespace RectifiedTransport

#endif
