// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/LatticeExtent.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

std::optional<std::array<int, 6>> extentIn(const ImageGrid& lattice, const ImageGrid& grid)
{
  constexpr double rounding = 1e-6; // part of a spacing
  constexpr double largest = std::numeric_limits<int>::max() / 2;
  const Eigen::Vector3d offset = grid.Origin() - lattice.Origin();
  const bool sameAxes = (grid.Direction() - lattice.Direction()).cwiseAbs().maxCoeff() <= rounding;
  std::array<int, 6> place{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double spacing = lattice.Spacing()[axis];
    // The origin's place in the lattice, in spacings; it must be a whole number.
    const double along = lattice.Direction().col(axis).dot(offset) / spacing;
    const double steps = std::round(along);
    const double points = std::max(1, grid.NumberOfPoints()[a]);
    // The error of the spacing adds up over the points: at the last one it must be below the
    // rounding.
    if (!sameAxes || grid.IsAxis(a) != lattice.IsAxis(a) || !(std::abs(steps) < largest) ||
      std::abs(along - steps) > rounding ||
      std::abs(grid.Spacing()[axis] - spacing) * points > rounding * std::abs(spacing))
    {
      return std::nullopt;
    }
    for (std::size_t end = 2 * a; end < 2 * a + 2; ++end)
    {
      const double at = grid.Extent()[end] + steps;
      if (!(std::abs(at) < largest))
      {
        return std::nullopt;
      }
      place[end] = static_cast<int>(at);
    }
  }
  return place;
}

} // namespace RectifiedTransport
