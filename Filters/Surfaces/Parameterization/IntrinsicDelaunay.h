// SPDX-License-Identifier: BSD-3-Clause
// The intrinsic Delaunay triangulation of a surface.
#ifndef RectifiedTransport_IntrinsicDelaunay_h
#define RectifiedTransport_IntrinsicDelaunay_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/DiskMesh.h"

#include <array>
#include <cstdint>

namespace RectifiedTransport
{

// Triangles whose sides are straight in the surface, not in space, given by the lengths of the
// sides.
struct IntrinsicTriangles
{
  // Three point ids a triangle.
  LargeBuffer<std::array<std::int64_t, 3>> Points;
  LargeBuffer<std::array<double, 3>> Lengths; // by triangles; side i is from corner i to the next

  // The cotangents of the angles opposite to the sides.
  std::array<double, 3> Cotangents(std::int64_t triangle) const;
};

// Flips edges until the two angles opposite to each edge sum to at most pi (Bobenko and Springborn
// 2007, doi:10.1007/s00454-006-9006-1), so that the weights of the Laplacian are not negative. If
// triangles are so thin that their lengths violate the triangle inequality, all lengths first grow
// by the same small amount (Sharp and Crane 2020, doi:10.1111/cgf.14069). On one thread. Memory: 72
// bytes a triangle. Throws std::bad_alloc and Cancelled.
IntrinsicTriangles triangulateDelaunay(const DiskMesh& disk, const Context& context = Context());

} // namespace RectifiedTransport

#endif
