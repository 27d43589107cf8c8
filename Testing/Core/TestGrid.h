// SPDX-License-Identifier: BSD-3-Clause
// Grids in physical space for tests.
#ifndef RectifiedTransport_TestGrid_h
#define RectifiedTransport_TestGrid_h

#include "Core/Geometry/ImageGrid.h"

#include <array>

namespace RectifiedTransport
{

// Cells of these sides along the axes of space, the first of them at `origin`.
template <int Dimension>
ImageGrid makeGrid(const GridSize<Dimension>& size, const Eigen::Vector3d& spacing,
  const Eigen::Vector3d& origin = Eigen::Vector3d::Zero())
{
  std::array<int, 6> extent{};
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    extent[2 * axis + 1] = static_cast<int>(size[axis]);
  }
  return ImageGrid(extent, origin, spacing, ImageGrid::Matrix::Identity(), false);
}

} // namespace RectifiedTransport

#endif
