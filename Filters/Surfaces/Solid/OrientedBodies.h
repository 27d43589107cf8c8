// SPDX-License-Identifier: BSD-3-Clause
// Orients the triangles of closed surfaces and numbers the bodies that they enclose.
#ifndef RectifiedTransport_OrientedBodies_h
#define RectifiedTransport_OrientedBodies_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/SurfaceEdges.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>

namespace RectifiedTransport
{

struct OrientedBodies
{
  bool IsOrientable; // not so: a Klein bottle
  // The number of each triangle's body, from 0. The triangles of a body pass each of their edges as
  // often one way as the other.
  LargeBuffer<std::int64_t> Bodies;
};

// Each edge of the surface has an even number of triangles. Turns triangles in place so that each
// edge is passed as often one way as the other, and a winding number is defined. Patches are
// triangles joined by edges of two. First each patch gets the orientation of most of its area: if
// that is inside out, it is the same solid by the winding number, and inside another one a cavity.
// Patches that agree already and balance every edge between them, as those of voxels or of a
// contour, stay so: overlapping parts are united as elsewhere. Other patches joined by edges are
// turned so that inside is where the number of crossings is odd: about an edge, in the order of
// their angles, triangles alternately face each other. Of the two ways, the one that keeps most of
// the area is used. Triangles at the same angle face each other.
//
// Memory: 17 bytes a triangle, and 100 for each side at an edge of more than two. On one thread.
// Throws std::bad_alloc and Cancelled.
OrientedBodies orientBodies(const TriangleSurface& surface, const SurfaceEdges& edges,
  std::int64_t* triangles, const Context& context = Context());

} // namespace RectifiedTransport

#endif
