// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Drawing/DrawnExtent.h"

#include "Core/Messages/Failure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

void requireFinite(const double* point, std::int64_t number)
{
  if (!std::all_of(point, point + 3, [](double x) { return std::isfinite(x); }))
  {
    fail("The input has a point that is NaN or infinite, at index ", number,
      "; all coordinates must be finite");
  }
}

} // namespace

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

void DrawnExtent::Include(const double* point, std::int64_t number, double radius)
{
  requireFinite(point, number);
  if (!(radius >= 0.0) || !std::isfinite(radius))
  {
    fail("RadiusArray has the value ", radius, " at index ", number,
      "; every radius must be finite and not negative");
  }
  this->Points.Include(point);
  this->Rest.Include(point, radius);
}

void DrawnExtent::IncludeDot(const double* point, std::int64_t number)
{
  requireFinite(point, number);
  this->Points.Include(point);
  this->Dots.Include(point);
  ++this->NumberOfDots;
}

double DrawnExtent::RadiusWithoutNeighbours() const
{
  constexpr double share = 0.01; // of the longest side
  const double longest =
    std::max({ this->Points.Length(0), this->Points.Length(1), this->Points.Length(2) });
  return longest > 0.0 ? share * longest : 1.0;
}

} // namespace RectifiedTransport
