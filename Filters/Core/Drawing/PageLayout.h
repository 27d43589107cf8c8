// SPDX-License-Identifier: BSD-3-Clause
// Where data lie on a page.
#ifndef RectifiedTransport_PageLayout_h
#define RectifiedTransport_PageLayout_h

#include "Core/Drawing/DrawingExtent.h"
#include "Core/Geometry/Points.h"

#include <array>

namespace RectifiedTransport
{

// The first axis points to the right, the second one up. The bounds fill the width, except for the
// margin on all four sides. If they are a vertical line, its length fills the width instead.
class PageLayout
{
public:
  // `width` and `margin` in millimetres. Throws Failure if the lengths, or millimetres
  // for a unit of them, are past the largest double.
  PageLayout(const std::array<Eigen::Index, 2>& axes, const DrawingBounds& bounds, double width,
    double margin);

  // Millimetres for a unit of the data.
  double Scale() const { return this->Unit; }
  const Point<2>& Size() const { return this->Sides; }
  Point<2> At(const double* point) const
  {
    return { this->Margins[0] + this->Unit * (point[this->Axes[0]] - this->Origin[0]),
      this->Margins[1] + this->Unit * (point[this->Axes[1]] - this->Origin[1]) };
  }

private:
  std::array<Eigen::Index, 2> Axes;
  Point<2> Origin;
  Point<2> Margins;
  Point<2> Sides;
  double Unit;
};

// In millimetres, but for the bounds.
struct PageSettings
{
  double Width;
  double Margin;                // on all four sides
  std::array<double, 6> Bounds; // bounds of the data on the page; all 0: bounds of the drawn shapes
  double LineWidth;

  bool HasBounds() const { return this->Bounds != std::array<double, 6>{}; }
  // Throws Failure unless they are ascending along at least two axes.
  void CheckBounds() const;
  // Returns a page in a format whose sides are at most `longestSide`. Throws Failure for margins
  // beyond the width, bounds that are too small for the drawn shapes, and pages that are too long.
  PageLayout Layout(const DrawingExtent& extent, double longestSide) const;

private:
  PageLayout LayoutInBounds(const DrawingBounds& drawn) const;
};

} // namespace RectifiedTransport

#endif
