// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Boxes/GridResolution.h"

#include "Core/Messages/PropertyCheck.h"

#include <cmath>

namespace RectifiedTransport
{

namespace
{

// The message of a number of values that cannot be, with all three numbers.
[[noreturn]] void failValues(const char* property, const int values[3], const std::string& rule)
{
  fail(property, " is ", values[0], " ", values[1], " ", values[2], "; it must be ", rule);
}

} // namespace

// The limit keeps extents within int.
void requireResolution(const char* property, int resolution)
{
  const std::string rule = "from 1 to " + std::to_string(MaximumResolution);
  requireThat(
    resolution >= 1 && resolution <= MaximumResolution, property, resolution, rule.c_str());
}

// One cell on the box. Its sides become the spacing, so that gridWithResolution can divide it.
ImageGrid gridOfBox(const double (&bounds)[6])
{
  // Shorter sides are rounding errors of data that are flat.
  constexpr double flat = 1e-9;
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    longest = std::max(longest, bounds[2 * i + 1] - bounds[2 * i]);
  }
  std::array<int, 6> extent{};
  Eigen::Vector3d origin;
  Eigen::Vector3d spacing;
  for (int i = 0; i < 3; ++i)
  {
    const double length = bounds[2 * i + 1] - bounds[2 * i];
    // Infinite sides stay axes, so that later checks find them.
    const bool isAxis = length > 0.0 && length >= flat * longest; // infinite ones too
    extent[static_cast<std::size_t>(2 * i + 1)] = isAxis ? 1 : 0;
    origin[i] = bounds[2 * i];
    spacing[i] = isAxis ? length : 1.0;
  }
  return { extent, origin, spacing, ImageGrid::Matrix::Identity(), false };
}

// A density needs cells of a measure above 0, in at least one dimension.
void requireCells(const ImageGrid& grid)
{
  if (grid.Dimension() == 0)
  {
    throw Failure("The input image has one point along every axis; a density needs at least one "
                  "axis of two points or more");
  }
  if (!grid.HasCells())
  {
    fail("The image's spacing is (", grid.Spacing()[0], ", ", grid.Spacing()[1], ", ",
      grid.Spacing()[2],
      "); origin, spacing and direction must be finite, and every axis of more than one point "
      "needs a spacing that is not 0 and a direction of its own, none so large or small that a "
      "corner of the image or a cell's measure is no number");
  }
}

// 0 keeps the input's number along an axis; the domain stays the same.
ImageGrid gridWithValues(const ImageGrid& grid, const int wanted[3], const char* property)
{
  if (*std::min_element(wanted, wanted + 3) < 0)
  {
    failValues(property, wanted, "0 (as many as the input) or greater along every axis");
  }
  // The checks name all three numbers, as the user gave them, and the axis that is wrong.
  const std::array<int, 3> values = grid.NumberOfValues();
  for (std::size_t i = 0; i < 3; ++i)
  {
    const int count = wanted[i];
    // The number that the image has is allowed, even above the limit.
    if (count == 0 || count == values[i])
    {
      continue;
    }
    const std::string axis = std::string(" along ") + "xyz"[i];
    if (!grid.IsAxis(i))
    {
      failValues(property, wanted, "0 or 1" + axis + ", where the input has one point");
    }
    if (grid.IsOnPoints() && count == 1)
    {
      failValues(property, wanted,
        "0 or at least 2" + axis + ": points have no axis where there is one of them");
    }
    if (count > MaximumResolution)
    {
      failValues(
        property, wanted, "at most " + std::to_string(MaximumResolution) + " along every axis");
    }
  }
  return grid.WithValues({ wanted[0], wanted[1], wanted[2] });
}

// cells along an axis = resolution times length / longest length, rounded, at least 1.
ImageGrid gridWithResolution(const ImageGrid& grid, int resolution, const char* property)
{
  requireResolution(property, resolution);
  // Lengths are those of the image's cells, also for values on points.
  const std::array<int, 3> cells = grid.WithValuesOn(false).NumberOfValues();
  double lengths[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    // Spacings may be negative; axes of one point have no length.
    const double spacing = grid.Spacing()[static_cast<Eigen::Index>(i)];
    lengths[i] = grid.IsAxis(i) ? std::abs(spacing) * cells[i] : 0.0;
  }
  const double longest = std::max({ lengths[0], lengths[1], lengths[2] });
  // 0 stays where the image has no axis.
  int wanted[3] = { 0, 0, 0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (lengths[i] > 0.0)
    {
      // The quotient of the lengths is at most 1: the product with the resolution cannot overflow.
      wanted[i] = std::max(1, static_cast<int>(std::lround(resolution * (lengths[i] / longest))));
    }
  }
  return gridWithValues(grid.WithValuesOn(false), wanted, property);
}

// The margin is a part of the longest axis; along others, as many of their own cells as cover it.
GridSize<3> cellsOfMargin(const ImageGrid& grid, double margin)
{
  constexpr double rounding = 1e-9; // part of a cell that must not add another one
  // Lengths are physical, and axes are those of index space.
  const Point<3> lengths = grid.Lengths<3>();
  const double longest = *std::max_element(lengths.begin(), lengths.begin() + grid.Dimension());
  GridSize<3> cells{};
  for (int a = 0; a < grid.Dimension(); ++a)
  {
    const auto axis = static_cast<std::size_t>(a);
    const auto size = static_cast<double>(grid.Size<3>()[axis]);
    // margin longest / (lengths / size), in cells
    const double around = std::ceil(margin * (longest / lengths[axis]) * size - rounding);
    // The negation refuses a margin that is not a number, too.
    if (!(size + 2.0 * around <= MaximumResolution))
    {
      throw Failure("Margin is " + textOf(margin) + "; it makes more than " +
        std::to_string(MaximumResolution) + " cells along an axis");
    }
    cells[axis] = static_cast<std::int64_t>(around);
  }
  return cells;
}

// A product of doubles: three ints may exceed every integer.
double numberOfValues(const ImageGrid& grid)
{
  double number = 1.0;
  for (const int values : grid.NumberOfValues())
  {
    number *= values;
  }
  return number;
}

// Axes of one point are left out, so that an image of a plane has two numbers.
std::string describeValues(const ImageGrid& grid)
{
  std::string text;
  const std::array<int, 3> values = grid.NumberOfValues();
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (grid.IsAxis(i))
    {
      text += (text.empty() ? "" : " x ") + std::to_string(values[i]);
    }
  }
  return text;
}

} // namespace RectifiedTransport
