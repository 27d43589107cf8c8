// SPDX-License-Identifier: BSD-3-Clause
// Orients the triangles of a closed surface consistently.
#ifndef RectifiedTransport_SurfaceOrientation_h
#define RectifiedTransport_SurfaceOrientation_h

#include "Core/Parallel/Context.h"
#include "Core/Solid/SurfaceEdges.h"

#include <cstdint>

namespace RectifiedTransport
{

// Writes the triangles of a surface, whose edges have two sides each, to `oriented`, which may be
// their own memory: each with its corners as given or in the opposite order. A component, that is
// triangles joined by edges, gets the orientation of most of its area, even if that is inside out:
// by the winding number it is the same solid, and within another one a cavity.
//
// Returns false if the surface is not orientable, as a Klein bottle. Memory: 9 bytes a triangle. On
// one thread. Throws std::bad_alloc and Cancelled.
bool orientSurface(const TriangleSurface& surface, const SurfaceEdges& edges,
  std::int64_t* oriented, const Context& context = Context());

} // namespace RectifiedTransport

#endif
