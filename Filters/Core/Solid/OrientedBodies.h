// SPDX-License-Identifier: BSD-3-Clause
// Orients the triangles of closed surfaces, and numbers the bodies that they are the surfaces of.
#ifndef RectifiedTransport_OrientedBodies_h
#define RectifiedTransport_OrientedBodies_h

#include "Core/Mesh/SurfaceEdges.h"
#include "Core/Mesh/TriangleSurface.h"
#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"

#include <cstdint>

namespace RectifiedTransport
{

struct OrientedBodies
{
  bool IsOrientable; // not so: a Klein bottle
  // Of each triangle the number of its body, from 0: triangles that pass each of their edges as
  // often one way as the other.
  LargeBuffer<std::int64_t> Bodies;
};

// Turns triangles of a surface whose edges each have an even number of triangles, in place, so that
// each edge is passed as often one way as the other, and a winding number is defined. Patches are
// triangles joined by edges of two. First each patch gets the orientation of most of its area: if
// that is inside out, it is by the winding number the same solid, and within another one a cavity.
// Patches that agree as they are and balance every edge between them, as of voxels or of a contour,
// stay so: parts that overlap are united as elsewhere. Others that are joined by edges are turned
// so that inside is what an odd number of crossings says: about an edge, in the order of their
// angles, triangles face each other by turns; of the two ways the one that keeps most of the area.
// Triangles at one angle face each other.
//
// Memory: 17 bytes a triangle, and 100 for each side at an edge of more than two. On one thread.
// Throws std::bad_alloc and Cancelled.
OrientedBodies orientBodies(const TriangleSurface& surface, const SurfaceEdges& edges,
  std::int64_t* triangles, const Context& context = Context());

} // namespace RectifiedTransport

#endif
