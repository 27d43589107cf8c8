// SPDX-License-Identifier: BSD-3-Clause
// How far points lie apart and from the origin.
#ifndef RectifiedTransport_PointBounds_h
#define RectifiedTransport_PointBounds_h

#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{

// The smallest box [Low, High] around what was added; empty at first: Low is infinite, High minus
// infinite.
template <int Dimension>
struct Bounds
{
  void Add(const double* x) { this->Add(x, x); }
  void Add(const Bounds& other) { this->Add(other.Low.data(), other.High.data()); }
  void Add(const double* low, const double* high)
  {
    for (std::size_t axis = 0; axis < Dimension; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], low[axis]);
      this->High[axis] = std::max(this->High[axis], high[axis]);
    }
  }

  // The bounds of places along their first axes.
  template <class Places>
  static Bounds Of(const Places& places)
  {
    Bounds bounds;
    for (const auto& place : places)
    {
      bounds.Add(place.data());
    }
    return bounds;
  }

  double LongestSide() const { return this->Length(this->Longest()); }
  double Length(std::size_t axis) const { return this->High[axis] - this->Low[axis]; }
  // The axis of the longest side.
  std::size_t Longest() const
  {
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < Dimension; ++axis)
    {
      longest = this->Length(axis) > this->Length(longest) ? axis : longest;
    }
    return longest;
  }

  static Point<Dimension> filled(double value)
  {
    Point<Dimension> point;
    point.fill(value);
    return point;
  }
  Point<Dimension> Low = filled(std::numeric_limits<double>::infinity());
  Point<Dimension> High = filled(-std::numeric_limits<double>::infinity());
};
using PointBounds = Bounds<3>;

// The largest coordinate of points, without its sign; 0 if there are none.
inline double largestCoordinate(ConstPointSpan<3> points)
{
  return std::accumulate(points.data(), points.data() + 3 * points.size(), 0.0,
    [](double largest, double x) { return std::max(largest, std::abs(x)); });
}

// A power of two that brings a length near 1, so that squares neither overflow nor underflow; 1 for
// the length 0.
inline double scaleToUnit(double length)
{
  constexpr int most = 1000; // the scale is finite
  return length > 0.0 ? std::ldexp(1.0, std::clamp(-std::ilogb(length), -most, most)) : 1.0;
}

} // namespace RectifiedTransport

#endif
