// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Boxes/SolidGrid.h"

#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/PropertyCheck.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

// What can be checked before the surface is known.
void requireSolidGrid(int resolution, double padding)
{
  requireResolution("Resolution", resolution);
  requireThat(padding >= 0.0 && std::isfinite(padding), "Padding", padding,
    "0 or a positive number, a share of the longest side");
}

ImageGrid solidGrid(const std::array<double, 6>& bounds, int resolution, double padding)
{
  requireSolidGrid(resolution, padding);
  // The longest side, infinite if a side is not a number, and the farthest coordinate.
  double longest = 0.0;
  double farthest = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double length = bounds[2 * a + 1] - bounds[2 * a];
    longest = std::isfinite(length) ? std::max(longest, length) : HUGE_VAL;
    farthest = std::max({ farthest, std::abs(bounds[2 * a]), std::abs(bounds[2 * a + 1]) });
  }
  const double grown = longest * (1.0 + 2.0 * padding);
  // Four times the sides must be finite: the corners of cells are computed from them.
  if (!std::isfinite(4.0 * grown))
  {
    fail("Padding is ", padding, " and the input's longest side ", longest,
      "; the box around it must have finite sides");
  }
  // Cubic cells: all axes share the width of the longest axis.
  const double width = grown / resolution;
  // Narrower cells are not resolved by coordinates in double precision.
  constexpr double smallest = 1e-12;
  if (!(width >= std::max(smallest * farthest, std::numeric_limits<double>::min())))
  {
    fail("Resolution is ", resolution, ", which makes cells of ", width,
      " for coordinates of up to ", farthest,
      "; cells must be at least 1e-12 of that: lower Resolution, or move the surface nearer to the "
      "origin");
  }
  std::array<int, 6> extent{};
  Eigen::Vector3d corner;
  for (std::size_t a = 0; a < 3; ++a)
  {
    // Rounding errors must not add a cell.
    constexpr double rounding = 1e-9;
    const double length = bounds[2 * a + 1] - bounds[2 * a];
    const double part = (length + 2.0 * padding * longest) / grown;
    const double cells = std::min(std::ceil(part * resolution - rounding), 1.0 * resolution);
    extent[2 * a + 1] = std::max(1, static_cast<int>(cells));
    const double centre = bounds[2 * a] + 0.5 * length;
    corner[static_cast<Eigen::Index>(a)] = centre - 0.5 * width * extent[2 * a + 1];
  }
  return { extent, corner, Eigen::Vector3d::Constant(width), ImageGrid::Matrix::Identity(), false };
}

} // namespace RectifiedTransport
