// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/PlaneFrame.h"

#include "Core/Geometry/Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace RectifiedTransport
{

namespace
{

// Scales a vector to the length 1; it must not be zero.
void normalize(Point<3>& vector)
{
  const double length = lengthOf(vector);
  std::transform(
    vector.begin(), vector.end(), vector.begin(), [=](double x) { return x / length; });
}

} // namespace

// The first axis is as near to that of x (or of y, if the normal is nearly along x) as the plane
// has, and the second one makes the frame right-handed about a normal that points up.
PlaneFrame::PlaneFrame(const Point<3>& origin, const Point<3>& normal)
  : Origin(origin)
{
  Point<3>& up = this->Axes[2];
  up = normal;
  normalize(up);
  // Within 2.6 degrees of the x axis, x has too small a part in the plane.
  constexpr double nearly = 0.999;
  const int along = std::abs(up[0]) < nearly ? 0 : 1;
  // The normal's z component is made positive; if it is 0 to rounding, y, else x.
  const int high = std::abs(up[2]) > 1e-9 ? 2 : std::abs(up[1]) > 1e-9 ? 1 : 0;
  if (up[static_cast<std::size_t>(high)] < 0.0)
  {
    std::transform(up.begin(), up.end(), up.begin(), [](double x) { return 0.0 - x; });
  }
  // Gram and Schmidt: the axis minus its part along the normal.
  Point<3>& first = this->Axes[0];
  first = { 0.0, 0.0, 0.0 };
  first[static_cast<std::size_t>(along)] = 1.0;
  const double part = up[static_cast<std::size_t>(along)];
  for (std::size_t i = 0; i < 3; ++i)
  {
    first[i] -= part * up[i];
  }
  normalize(first);
  this->Axes[1] = cross(up, first);
}

Point<2> PlaneFrame::ToPlane(const Point<3>& place) const
{
  const Point<3> offset = place - this->Origin;
  return { dot(offset, this->Axes[0]), dot(offset, this->Axes[1]) };
}

double PlaneFrame::Distance(const Point<3>& place) const
{
  return dot(place - this->Origin, this->Axes[2]);
}

Point<3> PlaneFrame::ToSpace(const Point<2>& inPlane, double distance) const
{
  return this->Origin + inPlane[0] * this->Axes[0] + inPlane[1] * this->Axes[1] +
    distance * this->Axes[2];
}

// The vector area sum (x_i - x_0) x (x_(i+1) - x_0) is twice the area, along the normal. Rings may
// run either way: each is added with the sign that agrees with the largest one so far.
void RingPlane::Add(const std::vector<Point<3>>& ring)
{
  Point<3> area{ 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    this->Bounds.Add(ring[i].data());
    area = area + cross(ring[i] - ring.front(), ring[(i + 1) % ring.size()] - ring.front());
  }
  this->Largest = lengthOf(area) > lengthOf(this->Largest) ? area : this->Largest;
  this->Sum = this->Sum + (dot(area, this->Largest) < 0.0 ? -1.0 : 1.0) * area;
}

bool RingPlane::HasArea() const
{
  return lengthOf(this->Sum) > 0.0;
}

PlaneFrame RingPlane::Frame() const
{
  return PlaneFrame(0.5 * (this->Bounds.Low + this->Bounds.High), this->Sum);
}

double RingPlane::Extent() const
{
  return std::hypot(this->Bounds.Length(0), this->Bounds.Length(1), this->Bounds.Length(2));
}

} // namespace RectifiedTransport
