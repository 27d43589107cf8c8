// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Drawing/PageLayout.h"

#include "Core/Messages/Failure.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

// Leaves out the shortest axis, or the last one of those that are equally short.
std::array<Eigen::Index, 2> longestAxes(const DrawingBounds& bounds)
{
  Eigen::Index last = 0;
  // The search from the back finds the last of several shortest axes.
  bounds.sizes().reverse().minCoeff(&last);
  return { last == 2 ? 1 : 0, last == 0 ? 1 : 2 };
}

} // namespace

PageLayout::PageLayout(const std::array<Eigen::Index, 2>& axes, const DrawingBounds& bounds,
  double pageWidth, double margin)
  : Axes(axes)
  , Origin{ bounds.min()[axes[0]], bounds.min()[axes[1]] }
  , Margins{ margin, margin }
{
  constexpr double rounding = 1e-9;       // relative to the lengths
  constexpr double shortestHeight = 1e-3; // for a page whose polygons have no area
  const double width = bounds.sizes()[axes[0]];
  const double height = bounds.sizes()[axes[1]];
  if (!std::isfinite(width) || !std::isfinite(height))
  {
    fail("The input has a length past the largest double; its coordinates must be smaller");
  }
  // Data on a vertical line determine the scale by their height.
  const bool isVertical = width <= rounding * height;
  const double length = isVertical ? height : width;
  // Millimetres for a unit of length; a single point has no length and any unit.
  this->Unit = length > 0.0 ? (pageWidth - 2.0 * margin) / length : 1.0;
  if (!std::isfinite(this->Unit))
  {
    fail("The input is ", length, " long, too little for a page; its coordinates must be larger");
  }
  this->Sides = { pageWidth, std::max(this->Unit * height + 2.0 * margin, shortestHeight) };
  // The width is centred, which only matters for a vertical line.
  this->Margins[0] = 0.5 * (pageWidth - this->Unit * width);
}

void PageSettings::CheckBounds() const
{
  const std::array<double, 6>& bounds = this->Bounds;
  int ascending = 0;
  int equal = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = bounds[2 * axis + 1] - bounds[2 * axis];
    // An axis has a positive length, or no extent at all, which at most one may have.
    ascending += length > 0.0 && std::isfinite(length) ? 1 : 0;
    equal += length == 0.0 ? 1 : 0;
  }
  if (this->HasBounds() && (ascending < 2 || ascending + equal < 3))
  {
    fail("PageBounds are ", bounds[0], " ", bounds[1], " ", bounds[2], " ", bounds[3], " ",
      bounds[4], " ", bounds[5],
      "; they must be the lowest and highest x, y and z, and longer than 0 along two axes, or all "
      "0");
  }
}

PageLayout PageSettings::LayoutInBounds(const DrawingBounds& drawn) const
{
  constexpr double farthest = 1e6; // millimetres, for numbers that all readers take
  const std::array<double, 6>& bounds = this->Bounds;
  const DrawingBounds shown(Eigen::Vector3d(bounds[0], bounds[2], bounds[4]),
    Eigen::Vector3d(bounds[1], bounds[3], bounds[5]));
  const PageLayout layout(longestAxes(shown), shown, this->Width, this->Margin);
  // Both corners of the drawn shapes bound all their coordinates on the page.
  for (const double* corner : { drawn.min().data(), drawn.max().data() })
  {
    for (const double distance : layout.At(corner))
    {
      if (!(std::abs(distance) <= farthest))
      {
        fail("PageBounds are so small that the input reaches ", std::abs(distance),
          " mm from the page; it may reach ", farthest, " mm: cut it with Clip or Threshold");
      }
    }
  }
  return layout;
}

PageLayout PageSettings::Layout(const DrawingExtent& extent, double longestSide) const
{
  // Strokes reach half their width beyond the points; given bounds are used as they are.
  const bool fitsStrokes = extent.HasStrokes && !this->HasBounds();
  const double margin = this->Margin + (fitsStrokes ? 0.5 * this->LineWidth : 0.0);
  if (!(2.0 * margin < this->Width))
  {
    fail("Width is ", this->Width, "; it must be more than ", 2.0 * margin,
      fitsStrokes ? ", twice PageMargin and the LineWidth" : ", twice PageMargin");
  }
  const PageLayout layout = this->HasBounds()
    ? this->LayoutInBounds(extent.OtherShapes)
    : PageLayout(longestAxes(extent.Points), extent.OtherShapes, this->Width, margin);
  const Point<2>& size = layout.Size();
  // Formats limit the size of a page.
  const double longest = std::max(size[0], size[1]);
  if (longest > longestSide)
  {
    fail("The page is ", size[0], " x ", size[1], " mm with Width ", this->Width,
      "; no side may be longer than ", longestSide, " mm in this format: Width must be at most ",
      this->Width * longestSide / longest);
  }
  return layout;
}

} // namespace RectifiedTransport
