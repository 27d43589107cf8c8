// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a surface, and what is near it.
#ifndef RectifiedTransport_SurfaceBoundary_h
#define RectifiedTransport_SurfaceBoundary_h

#include "Core/Geometry/Trees/ItemTree.h"
#include "Surfaces/SurfaceRelaxation/DotTree.h"
#include "Surfaces/SurfaceRelaxation/GeodesicTracer.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// A tree of the bounding boxes of the sides that are boundaries of triangles with area.
class SurfaceBoundary
{
public:
  // Keeps a view of the surface. Throws std::bad_alloc and Cancelled.
  SurfaceBoundary(const GeodesicTracer& tracer, Progress& progress);
  // Bytes that it takes at most, about, for a number of sides.
  static double MemoryFor(double sides);

  // The sides that may be nearer to a box than a distance.
  void FindNear(const DotBox& box, double distance, std::vector<std::int64_t>& found) const;
  // The vector to a point from the nearest point of some sides.
  Point<3> FromNearest(const std::vector<std::int64_t>& sides, const Point<3>& x) const;

private:
  const GeodesicTracer& Tracer;
  std::optional<ItemTree> Sides; // ids of sides
};

} // namespace RectifiedTransport

#endif
