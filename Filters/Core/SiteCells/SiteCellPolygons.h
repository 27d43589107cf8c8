// SPDX-License-Identifier: BSD-3-Clause
// The site cells of a labelled image of two dimensions as polygons along the sides of its pixels.
#ifndef RectifiedTransport_SiteCellPolygons_h
#define RectifiedTransport_SiteCellPolygons_h

#include "../Geometry/ImageGrid.h"
#include "../Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Polygon k has the corners CornerIds[First[k]] to CornerIds[First[k + 1] - 1].
struct SiteCellPolygons
{
  std::vector<Point<3>> Points;        // in physical space
  std::vector<std::int64_t> CornerIds; // which of the points
  std::vector<std::int64_t> First;     // one more than there are polygons
  std::vector<std::int64_t> SiteIds;   // site of each polygon, in ascending order
};

// Polygons without holes: one for each set of pixels of one site that are connected by their sides;
// where such a set has holes, it is cut along sides of pixels on the left and the right of each
// hole. Pixels of the label -1 are of no site. Polygons turn from the image's first axis to the
// second, as the lines of outlineSiteCells. They have corners where they turn and where polygons
// meet, and share points. Takes 8 bytes a pixel. Throws std::bad_alloc and Cancelled.
SiteCellPolygons polygonsOfSiteCells(
  const ImageGrid& grid, const std::int64_t* labels, const Context& context = Context());

} // namespace RectifiedTransport

#endif
