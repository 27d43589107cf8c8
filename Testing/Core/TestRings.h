// SPDX-License-Identifier: BSD-3-Clause
// What the tests of regions and of triangles between rings share.
#ifndef RectifiedTransport_TestRings_h
#define RectifiedTransport_TestRings_h

#include "Core/Overlap/RingCrossings.h"

#include <vector>

namespace RectifiedTransport
{

using Ring = std::vector<Point<2>>;

inline Rings ringsOf(const std::vector<Ring>& all)
{
  Rings rings;
  for (const Ring& ring : all)
  {
    for (const Point<2>& x : ring)
    {
      rings.Add(x);
    }
    rings.EndRing();
  }
  return rings;
}

} // namespace RectifiedTransport

#endif
