// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/PageLayout.h"

#include "Bridge/Run/Failure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport::Bridge
{

DrawnBounds::DrawnBounds()
{
  this->Lower.fill(std::numeric_limits<double>::infinity());
  this->Upper.fill(-std::numeric_limits<double>::infinity());
}

void DrawnBounds::Include(const double* point, double radius)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Lower[axis] = std::min(this->Lower[axis], point[axis] - radius);
    this->Upper[axis] = std::max(this->Upper[axis], point[axis] + radius);
  }
}

void DrawnBounds::Include(const DrawnBounds& other, double radius)
{
  if (!other.IsEmpty())
  {
    this->Include(other.Lower.data(), radius);
    this->Include(other.Upper.data(), radius);
  }
}

std::array<std::size_t, 2> DrawnBounds::LongestAxes() const
{
  std::size_t shortest = 2;
  for (const std::size_t axis : { 1, 0 })
  {
    shortest = this->Length(axis) < this->Length(shortest) ? axis : shortest;
  }
  return { shortest == 0 ? std::size_t{ 1 } : 0, shortest == 2 ? std::size_t{ 1 } : 2 };
}

PageLayout::PageLayout(
  const std::array<std::size_t, 2>& axes, const DrawnBounds& bounds, PageSize page)
  : Axes(axes)
  , Origin{ bounds.LowerCorner()[axes[0]], bounds.LowerCorner()[axes[1]] }
  , Margins{ page.Margin, page.Margin }
{
  constexpr double rounding = 1e-9;       // of lengths
  constexpr double shortestHeight = 1e-3; // of a page whose polygons have no area
  const double width = bounds.Length(axes[0]);
  const double height = bounds.Length(axes[1]);
  if (!std::isfinite(width) || !std::isfinite(height))
  {
    fail("The input has a length past the largest double; its coordinates must be smaller");
  }
  const bool isVertical = width <= rounding * height;
  const double length = isVertical ? height : width;
  this->Unit = length > 0.0 ? (page.Width - 2.0 * page.Margin) / length : 1.0;
  if (!std::isfinite(this->Unit))
  {
    fail("The input is ", length, " long, too little for a page; its coordinates must be larger");
  }
  this->Sides = { page.Width, std::max(this->Unit * height + 2.0 * page.Margin, shortestHeight) };
  this->Margins[0] = 0.5 * (page.Width - this->Unit * width);
}

} // namespace RectifiedTransport::Bridge
