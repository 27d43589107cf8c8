// SPDX-License-Identifier: BSD-3-Clause
// Where the edges of rings cross, as points on each of them.
#ifndef RectifiedTransport_EdgeCrossings_h
#define RectifiedTransport_EdgeCrossings_h

#include "Core/Overlap/RingCrossings.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

struct EdgeCrossing
{
  std::int64_t Edge;
  double Along; // the edge, as a scalar product: 0 at its begin, its squared length at its end
  std::int64_t Other; // edge, which has the same crossing
  Point<2> X;
};

// In the order of the edges and along them. `areSimple`: whether it is known that no edges cross,
// before and after the call; it is not checked for few edges. `atEnds` as in findCrossings.
// Incomplete if `progress` is cancelled.
std::vector<EdgeCrossing> edgeCrossings(
  const Rings& rings, Progress& progress, bool& areSimple, bool atEnds = true);

} // namespace RectifiedTransport

#endif
