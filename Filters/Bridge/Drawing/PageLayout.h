// SPDX-License-Identifier: BSD-3-Clause
// Where data lie on a page.
#ifndef RectifiedTransport_PageLayout_h
#define RectifiedTransport_PageLayout_h

#include "Bridge/Drawing/Drawing.h"

#include <array>
#include <cstddef>

namespace RectifiedTransport::Bridge
{

// The bounds of what is drawn; at first of nothing.
class DrawnBounds
{
public:
  DrawnBounds();
  void Include(const double* point, double radius = 0.0);
  // Other bounds, and what lies around them up to this distance.
  void Include(const DrawnBounds& other, double radius);

  bool IsEmpty() const { return this->Lower[0] > this->Upper[0]; }
  const double* LowerCorner() const { return this->Lower.data(); }
  const double* UpperCorner() const { return this->Upper.data(); }
  double Length(std::size_t axis) const { return this->Upper[axis] - this->Lower[axis]; }
  // All but the axis of the least length; of equal lengths the last.
  std::array<std::size_t, 2> LongestAxes() const;

private:
  std::array<double, 3> Lower;
  std::array<double, 3> Upper;
};

// In millimetres.
struct PageSize
{
  double Width;
  double Margin; // on all four sides
};

// The first axis points to the right, the second up. The bounds fill the width but for the margins.
// If all of them lie on one vertical line, its length does instead.
class PageLayout
{
public:
  // Throws Failure if the lengths, or millimetres for a unit of them, are past the largest double.
  PageLayout(const std::array<std::size_t, 2>& axes, const DrawnBounds& bounds, PageSize page);

  // Millimetres for a unit of the data.
  double Scale() const { return this->Unit; }
  const PagePoint& Size() const { return this->Sides; }
  PagePoint At(const double* point) const
  {
    return { this->Margins[0] + this->Unit * (point[this->Axes[0]] - this->Origin[0]),
      this->Margins[1] + this->Unit * (point[this->Axes[1]] - this->Origin[1]) };
  }

private:
  std::array<std::size_t, 2> Axes;
  PagePoint Origin;
  PagePoint Margins;
  PagePoint Sides;
  double Unit;
};

} // namespace RectifiedTransport::Bridge

#endif
