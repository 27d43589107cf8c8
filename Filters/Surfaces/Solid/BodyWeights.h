// SPDX-License-Identifier: BSD-3-Clause
// Which bodies of a closed surface add to the solid, and which subtract from it.
#ifndef RectifiedTransport_BodyWeights_h
#define RectifiedTransport_BodyWeights_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Solid/SolidCoverage.h"

namespace RectifiedTransport
{

// The solid is where the winding number of all triangles is not 0. Each body has a weight 1, 0 or
// -1, so that the weighted sum of the bodies' windings is 1 in the solid and 0 outside, if bodies
// lie beside or within each other. The weight is 1 for an outward body and for its cavities, -1 for
// a body inside out, 0 for a body within another one of the same orientation. If bodies intersect
// each other or themselves, no weights are exact.
//
// Tests eight triangles of each body: the largest across axis 0 of either side, and the outermost.
// A line through each counts the winding numbers on both sides of it. Unless bodies coincide, the
// result does not depend on the order of the triangles. On one thread, in linear time for bodies
// that do not lie within many others. Memory: 9 bytes a point and a triangle, and 1 kB a body.
// Throws std::bad_alloc and Cancelled.
LargeBuffer<signed char> weighBodies(
  const SolidSurface& surface, const Context& context = Context());

} // namespace RectifiedTransport

#endif
