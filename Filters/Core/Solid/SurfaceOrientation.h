// SPDX-License-Identifier: BSD-3-Clause
// Makes the triangles of a closed surface turn the same way.
#ifndef RectifiedTransport_SurfaceOrientation_h
#define RectifiedTransport_SurfaceOrientation_h

#include "Core/Parallel/Context.h"
#include "Core/Solid/SurfaceEdges.h"

#include <cstdint>

namespace RectifiedTransport
{

// Of triangles, three indices each, whose edges have two sides each. A component, that is triangles
// joined by edges, keeps the orientation that most of its area has. One that most of its area turns
// inside out stays so: to the winding number it is the same solid, and within another one a cavity.
//
// Returns false if some triangles would have to turn both ways, as on a Klein bottle. Memory: 9
// bytes a triangle. On one thread. Throws std::bad_alloc and Cancelled.
bool orientSurface(ConstPointSpan<3> points, std::int64_t* triangles, std::int64_t count,
  const SurfaceEdges& edges, const Context& context = Context());

} // namespace RectifiedTransport

#endif
