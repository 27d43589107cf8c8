// SPDX-License-Identifier: BSD-3-Clause
// Orients the triangles of a surface consistently.
#ifndef RectifiedTransport_SurfaceOrientation_h
#define RectifiedTransport_SurfaceOrientation_h

#include "Core/Mesh/SurfaceEdges.h"
#include "Core/Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

struct SurfaceOrientation
{
  bool IsOrientable; // not so: a Klein bottle or a Moebius strip
  std::int64_t Components;
};

// Writes the triangles of a surface to `oriented`, which may be their own memory: each with its
// corners as given or in the opposite order. A component, that is triangles joined by edges of two
// sides, gets the orientation of most of its area. If that of a closed one is inside out, it is by
// the winding number the same solid, and within another one a cavity.
//
// Memory: 9 bytes a triangle. On one thread. Throws std::bad_alloc and Cancelled.
SurfaceOrientation orientSurface(const TriangleSurface& surface, const SurfaceEdges& edges,
  std::int64_t* oriented, const Context& context = Context());

} // namespace RectifiedTransport

#endif
