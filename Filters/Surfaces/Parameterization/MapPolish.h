// SPDX-License-Identifier: BSD-3-Clause
// Moves points of a map of a disk to the unit square, region by region, until its triangles have
// their areas and none is flipped.
#ifndef RectifiedTransport_MapPolish_h
#define RectifiedTransport_MapPolish_h

#include "Core/Parallel/Context.h"
#include "Surfaces/Parameterization/LocalMap.h"

#include <vector>

namespace RectifiedTransport
{

// One sweep over the points in regions: Gauss-Newton steps on the sum over triangles of (area in
// the square - area share)^2 / area share, damped by the surface's Dirichlet form. The first sweep,
// 0, is damped more and smooths the map; borders of regions differ between sweeps. Throws
// std::bad_alloc and Cancelled.
void polishAreas(const MapParts& parts, int sweep, std::vector<Point<2>>& positions,
  const Context& context = Context());

// Moves the points of `rings` rings of triangles around the flipped ones. Each patch takes
// Levenberg-Marquardt steps on the sum of squares of q - 1 if q = area / share is below 1, else of
// log q. A patch changes only if it then has fewer flipped triangles. Throws std::bad_alloc and
// Cancelled.
void repairFlips(const MapParts& parts, int rings, std::vector<Point<2>>& positions,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
