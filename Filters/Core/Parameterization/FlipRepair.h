// SPDX-License-Identifier: BSD-3-Clause
// Repairs flipped triangles of a map of a disk to the unit square.
#ifndef RectifiedTransport_FlipRepair_h
#define RectifiedTransport_FlipRepair_h

#include "Core/Parallel/Context.h"
#include "Core/Parameterization/LocalMap.h"

#include <vector>

namespace RectifiedTransport
{

// Moves the points of `rings` rings of triangles around the flipped ones. Each patch takes
// Levenberg-Marquardt steps on the sum of squares of q - 1 if q = area / share is below 1, else of
// log q. A patch changes only if it then has fewer flipped triangles. Throws std::bad_alloc and
// Cancelled.
void repairFlips(const MapParts& parts, int rings, std::vector<Point<2>>& positions,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
