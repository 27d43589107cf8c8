// SPDX-License-Identifier: BSD-3-Clause
// The borders of the site cells of a labelled image, along the faces of its pixels.
#ifndef RectifiedTransport_SiteCellOutlines_h
#define RectifiedTransport_SiteCellOutlines_h

#include "../Geometry/ImageGrid.h"
#include "../Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Faces that share points: points in 1D, lines in 2D, quads in 3D.
template <int Dimension>
struct SiteCellOutlines
{
  static constexpr int Corners = Dimension == 1 ? 1 : 2 * (Dimension - 1); // corners of a face

  std::vector<Point<3>> Points;        // in physical space
  std::vector<std::int64_t> CornerIds; // which of the points, Corners for each face
  std::vector<std::int64_t> SiteIds;   // the label of each face's site cell
};

// Each site cell has a closed border; a face between two cells is listed once for each. Quads are
// counterclockwise seen from outside. Lines run around their site cell in the direction of rotation
// from the image's first axis to the second. Throws std::bad_alloc and Cancelled.
template <int Dimension>
SiteCellOutlines<Dimension> outlineSiteCells(
  const ImageGrid& grid, const std::int64_t* labels, const Context& context = Context());

} // namespace RectifiedTransport

#endif
