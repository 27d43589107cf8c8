// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Boxes/BoxAdvice.h"

#include "Core/Messages/PropertyCheck.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

// Enlarges a box by the corners of an image's points. Beyond its points there is nothing to be
// sampled, also where the domain of a point array reaches half a spacing farther.
void addPoints(const ImageGrid& grid, Eigen::Vector3d& low, Eigen::Vector3d& high)
{
  const std::array<int, 6>& extent = grid.Extent();
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    Eigen::Vector3d steps;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto a = static_cast<Eigen::Index>(axis);
      steps[a] = grid.Spacing()[a] * extent[2 * axis + (corner >> axis & 1)];
    }
    const Eigen::Vector3d place = grid.Origin() + grid.Direction() * steps;
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
}

// The translation that brings the image's first layer into the plane through the origin across an
// axis, as the three numbers that Transform has.
std::string translateOf(const ImageGrid& grid, Eigen::Index axis)
{
  const Eigen::Vector3d normal = grid.Direction().col(axis).normalized();
  const auto first = static_cast<double>(grid.Extent()[2 * static_cast<std::size_t>(axis)]);
  const Eigen::Vector3d place = grid.Origin() + normal * (grid.Spacing()[axis] * first);
  std::string text;
  for (Eigen::Index i = 0; i < 3; ++i)
  {
    const double move = -place.dot(normal) * normal[i];
    text += (i > 0 ? " " : "") + textOf(move == 0.0 ? 0.0 : move);
  }
  return text;
}

} // namespace

std::string sameBoxAdvice(const ImageGrid& first, const ImageGrid& other)
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL);
  Eigen::Vector3d high = -low;
  addPoints(first, low, high);
  addPoints(other, low, high);
  // The finest spacing of the two, along each axis.
  const Eigen::Vector3d spacing = first.Spacing().cwiseAbs().cwiseMin(other.Spacing().cwiseAbs());
  std::string bounds;
  std::string dimensions;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<Eigen::Index>(axis);
    const double values =
      first.IsAxis(axis) ? std::round((high[a] - low[a]) / spacing[a]) + 1.0 : 1.0;
    bounds += textOf(low[a]) + " " + textOf(high[a]) + " ";
    dimensions += (axis > 0 ? " " : "") + textOf(std::clamp(values, 1.0, 1e9));
  }
  return "Resample To Image of each makes it so, with Use Input Bounds off and the same Sampling "
         "Bounds and Sampling Dimensions; " +
    bounds + "and " + dimensions + " hold these two";
}

// Both are moved to the plane through the origin, so that it does not matter which one is right.
std::string samePlaneAdvice(const ImageGrid& first, const ImageGrid& other, std::size_t axis)
{
  const auto a = static_cast<Eigen::Index>(axis);
  return "Transform of each makes it so, with the Translate " + translateOf(first, a) + " and " +
    translateOf(other, a);
}

} // namespace RectifiedTransport
