// SPDX-License-Identifier: BSD-3-Clause
// Vectors of space.
#ifndef RectifiedTransport_Vectors_h
#define RectifiedTransport_Vectors_h

#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

inline Point<3> operator+(const Point<3>& a, const Point<3>& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

inline Point<3> operator-(const Point<3>& a, const Point<3>& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline Point<3> operator*(double factor, const Point<3>& a)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

inline Point<3> operator/(const Point<3>& a, double divisor)
{
  return { a[0] / divisor, a[1] / divisor, a[2] / divisor };
}

inline double dot(const Point<3>& a, const Point<3>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Point<3> cross(const Point<3>& a, const Point<3>& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline double squaredDistance(const Point<3>& a, const Point<3>& b)
{
  return dot(a - b, a - b);
}

inline double squaredDistance(const Point<2>& a, const Point<2>& b)
{
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

inline double lengthOf(const Point<3>& vector)
{
  return std::sqrt(dot(vector, vector));
}

inline Point<3> pointAt(ConstPointSpan<3> points, std::int64_t i)
{
  return { points[i][0], points[i][1], points[i][2] };
}

// Whether no coordinate is infinite or NaN.
inline bool areFinite(ConstPointSpan<3> points)
{
  return std::all_of(points.data(), points.data() + 3 * points.size(),
    [](double coordinate) { return std::isfinite(coordinate); });
}

} // namespace RectifiedTransport

#endif
