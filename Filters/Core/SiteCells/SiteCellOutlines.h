// SPDX-License-Identifier: BSD-3-Clause
// The borders of the cells of a labelled image, along the sides of its pixels.
#ifndef RectifiedTransport_SiteCellOutlines_h
#define RectifiedTransport_SiteCellOutlines_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Faces that share points: points themselves in 1D, lines in 2D, quads in 3D.
template <int Dimension>
struct SiteCellOutlines
{
  static constexpr int Corners = Dimension == 1 ? 1 : 2 * (Dimension - 1); // of a face

  std::vector<Point<3>> Points;        // in physical space
  std::vector<std::int64_t> CornerIds; // which of the points, Corners for each face
  std::vector<std::int64_t> SiteIds;   // of each face, the label of its cell
};

// Each cell has its own closed border; what is between two cells is there once for each. Quads are
// seen from outside against the clock; lines go around their cell as the first of the image's axes
// turns to the second. Throws std::bad_alloc and Cancelled.
template <int Dimension>
SiteCellOutlines<Dimension> outlineSiteCells(
  const ImageGrid& grid, const std::int64_t* labels, const Context& context = Context());

} // namespace RectifiedTransport

#endif
