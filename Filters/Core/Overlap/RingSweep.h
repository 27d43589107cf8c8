// SPDX-License-Identifier: BSD-3-Clause
// Whether edges of rings cross at all; mostly they do not.
#ifndef RectifiedTransport_RingSweep_h
#define RectifiedTransport_RingSweep_h

#include "Core/Overlap/RingCrossings.h"

namespace RectifiedTransport
{

class Progress;

// In O(n log n) for any rings, by a line that sweeps the plane upwards (Shamos and Hoey 1976).
// Touching edges are treated as in findCrossings. Undefined if `progress` is cancelled.
bool haveCrossings(const Rings& rings, Progress& progress);

} // namespace RectifiedTransport

#endif
