// SPDX-License-Identifier: BSD-3-Clause
// Duplicate triangles of a surface.
#ifndef RectifiedTransport_DuplicateTriangles_h
#define RectifiedTransport_DuplicateTriangles_h

#include "Surfaces/Mesh/SurfaceEdges.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <array>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Triangles of the same three points; each has three edges of more than two triangles. Returns the
// triangles to drop, in ascending order, by three rules. By the first, triangles of one direction
// count once, and those of opposite directions cancel each other, as faces that two solids share.
// By the second, one of an odd number stays and none of an even number: the same with random
// directions. By the third, one stays: duplicate polygons. O(n log n) for n triangles with such
// edges.
std::array<std::vector<std::int64_t>, 3> findDropped(
  const TriangleSurface& surface, const SurfaceEdges& edges);

// Writes the triangles that stay, which may be to their own memory; returns their number.
std::int64_t dropTriangles(
  const TriangleSurface& surface, const std::vector<std::int64_t>& dropped, std::int64_t* kept);

} // namespace RectifiedTransport

#endif
