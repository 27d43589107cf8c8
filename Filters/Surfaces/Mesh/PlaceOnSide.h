// SPDX-License-Identifier: BSD-3-Clause
// Whether a point lies within a side of a triangle, up to rounding.
#ifndef RectifiedTransport_PlaceOnSide_h
#define RectifiedTransport_PlaceOnSide_h

#include "Core/Geometry/PointBounds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace RectifiedTransport
{

// Decides with the same tolerance for all sides, so that triangles on both sides of a line agree.
class PlaceOnSide
{
public:
  // For points within the bounds. They may be off by the largest of `rounding`, the rounding of
  // double, and 1e-6 of the longest side of the bounds.
  PlaceOnSide(const PointBounds& bounds, double rounding)
  {
    constexpr double relative = 1e-6;
    constexpr double units = 4.0;
    double farthest = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      farthest = std::max({ farthest, -bounds.Low[axis], bounds.High[axis] });
    }
    const double longest = std::max(0.0, bounds.Length(bounds.Longest()));
    this->Distance = std::max(
      { rounding, units * std::numeric_limits<double>::epsilon() * farthest, relative * longest });
    this->Scale = scaleToUnit(longest);
  }

  // How far points may be off.
  double Tolerance() const { return this->Distance; }

  // The place of x from 0 to 1 along the side from a to b: (x - a) . (b - a) / |b - a|^2. It is 0
  // if x is farther off the side than the tolerance, or is at one of its ends.
  double Of(const double* a, const double* b, const double* x) const
  {
    // Largest gap by length, where sides are not much longer than the tolerance.
    constexpr double steepest = 1.0 / 16.0;
    double squared = 0.0;
    double along = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double by = this->Scale * (b[axis] - a[axis]);
      squared += by * by;
      along += by * (this->Scale * (x[axis] - a[axis]));
    }
    const double place = along / squared;
    double gap = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double off = this->Scale * (x[axis] - a[axis] - place * (b[axis] - a[axis]));
      gap += off * off;
    }
    gap = std::sqrt(gap);
    const double length = std::sqrt(squared);
    const double limit = std::min(this->Scale * this->Distance, steepest * length);
    // Points so near to an end are at one place with it.
    const bool isWithin = gap <= limit && std::min(place, 1.0 - place) * length > limit;
    return isWithin ? place : 0.0;
  }

private:
  double Distance;
  double Scale; // so that squares neither overflow nor underflow
};

} // namespace RectifiedTransport

#endif
