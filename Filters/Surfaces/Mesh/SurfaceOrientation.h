// SPDX-License-Identifier: BSD-3-Clause
// Orients the triangles of a surface consistently.
#ifndef RectifiedTransport_SurfaceOrientation_h
#define RectifiedTransport_SurfaceOrientation_h

#include "Core/Parallel/Context.h"
#include "Surfaces/Mesh/SurfaceEdges.h"

#include <cstdint>
#include <functional>

namespace RectifiedTransport
{

class Progress;

struct SurfaceOrientation
{
  bool IsOrientable; // not so: a Klein bottle or a Moebius strip
  std::int64_t Components;
};

// Triangles joined by edges of two sides.
struct SurfacePatch
{
  const std::int64_t* Triangles;
  std::int64_t Count;
  double Area; // oriented as the patch, minus the rest; twice the area in space
};

// Orients each patch like most of its area and calls visit(patch), in the order of their first
// triangles. By then `signs` has 1 for each of its triangles that stays and -1 for each that is
// turned. Each triangle is a unit of progress. Returns whether all patches can be oriented. Memory:
// 8 bytes a triangle. On one thread. Throws std::bad_alloc and Cancelled.
bool visitPatches(const TriangleSurface& surface, const SurfaceEdges& edges, signed char* signs,
  Progress& progress, const std::function<void(const SurfacePatch&)>& visit);

// Writes the triangles of a surface to `oriented`, which may be their own memory, each with its
// corners as given or in the opposite order. A component (triangles joined by edges of two sides)
// gets the orientation of most of its area. A closed component that is inside out is the same solid
// by the winding number; inside another component it is a cavity.
//
// Memory: 9 bytes a triangle. On one thread. Throws std::bad_alloc and Cancelled.
SurfaceOrientation orientSurface(const TriangleSurface& surface, const SurfaceEdges& edges,
  std::int64_t* oriented, const Context& context = Context());

} // namespace RectifiedTransport

#endif
