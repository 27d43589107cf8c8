// SPDX-License-Identifier: BSD-3-Clause
// The components of a surface, parted where they touch.
#ifndef RectifiedTransport_SurfaceParts_h
#define RectifiedTransport_SurfaceParts_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Triangles part at edges of more than two triangles, and where they share only a point. Then all
// edges have at most two triangles, and those about a point form one fan.
class SurfaceParts
{
public:
  // The corners of a triangle are three different points. Memory: 24 bytes a triangle, and
  // temporarily 90 a triangle. On one thread. Throws std::bad_alloc and Cancelled.
  explicit SurfaceParts(const TriangleSurface& surface, const Context& context = Context());

  // The points of the parts that the corners of the triangles have, three a triangle; the numbers
  // ascend with their first corners.
  const std::int64_t* Corners() const { return this->Points.data(); }
  std::int64_t NumberOfPoints() const { return this->Count; }
  // The triangles of each component, ascending, in the order of their first triangles.
  const std::vector<std::vector<std::int64_t>>& Components() const { return this->Triangles; }
  std::int64_t NonManifoldEdges() const { return this->Parted; }

private:
  LargeBuffer<std::int64_t> Points; // three a triangle
  std::int64_t Count = 0;           // number of points
  std::int64_t Parted = 0;          // number of non-manifold edges
  std::vector<std::vector<std::int64_t>> Triangles;
};

} // namespace RectifiedTransport

#endif
