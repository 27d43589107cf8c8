// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Drawing/DrawingExtent.h"

#include "Core/Messages/Failure.h"

#include <cmath>

namespace RectifiedTransport
{

namespace
{

// Returns a point if it is finite; otherwise throws a Failure that names its index.
Eigen::Vector3d finite(const double* point, std::int64_t number)
{
  const Eigen::Map<const Eigen::Vector3d> place(point);
  if (!place.allFinite())
  {
    fail("The input has a point that is NaN or infinite, at index ", number,
      "; all coordinates must be finite");
  }
  return place;
}

void extend(DrawingBounds& bounds, const DrawingBounds& box, double radius)
{
  if (!box.isEmpty())
  {
    const Eigen::Vector3d border = Eigen::Vector3d::Constant(radius);
    bounds.extend(DrawingBounds(box.min() - border, box.max() + border));
  }
}

} // namespace

void DrawingExtent::Include(const double* point, std::int64_t number, double radius)
{
  const DrawingBounds place(finite(point, number));
  if (!(radius >= 0.0) || !std::isfinite(radius))
  {
    fail("RadiusArray has the value ", radius, " at index ", number,
      "; every radius must be finite and not negative");
  }
  this->Points.extend(place);
  extend(this->OtherShapes, place, radius);
}

void DrawingExtent::IncludeDot(const double* point, std::int64_t number)
{
  const Eigen::Vector3d place = finite(point, number);
  this->Points.extend(place);
  this->Dots.extend(place);
  ++this->NumberOfDots;
}

void DrawingExtent::SetRadiusOfDots(double radius)
{
  extend(this->OtherShapes, this->Dots, radius);
}

double DrawingExtent::RadiusWithoutNeighbours() const
{
  constexpr double share = 0.01; // part of the longest side
  const double longest = this->Points.sizes().maxCoeff();
  return longest > 0.0 ? share * longest : 1.0;
}

} // namespace RectifiedTransport
