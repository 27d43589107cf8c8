// SPDX-License-Identifier: BSD-3-Clause
// Which bodies of a closed surface add to the solid, and which take away from it.
#ifndef RectifiedTransport_BodyWeights_h
#define RectifiedTransport_BodyWeights_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Solid/SolidCoverage.h"

namespace RectifiedTransport
{

// The solid is where the winding number of all triangles is not 0. A weight a body, 1, 0 or -1,
// makes a weighted sum of the bodies' own windings that is 1 in the solid and 0 without, wherever
// bodies lie beside or within each other: 1 for one that is turned outward and for a cavity of such
// a one, -1 for one inside out, 0 for one within another that is turned the same way. Where bodies
// pass through each other or through themselves no weights are exact.
//
// Eight triangles of each body are looked at: the largest across axis 0 of either side, and the
// outermost. A line through each counts the winding numbers on both sides of it. Does not depend on
// the order of the triangles, but where bodies coincide. On one thread, in linear time for bodies
// that do not lie within many others. Memory: 9 bytes a point and a triangle, and 1 kB a body.
// Throws std::bad_alloc and Cancelled.
LargeBuffer<signed char> weighBodies(
  const SolidSurface& surface, const Context& context = Context());

} // namespace RectifiedTransport

#endif
