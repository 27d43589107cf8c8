// SPDX-License-Identifier: BSD-3-Clause
// The polygon that contains the centre of each pixel, for convex polygons that divide a grid.
#ifndef RectifiedTransport_LabelPolygons_h
#define RectifiedTransport_LabelPolygons_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Writes the number of a polygon for each pixel, axis 0 fastest. Polygon i has the corners
// [first[i], first[i + 1]), in index space; together they cover the grid to rounding. Throws
// std::bad_alloc and Cancelled.
void labelPolygons(const std::vector<Point<2>>& corners, const std::vector<std::int64_t>& first,
  const GridSize<2>& size, std::int64_t* labels, Progress& progress);

} // namespace RectifiedTransport

#endif
