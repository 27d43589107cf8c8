// SPDX-License-Identifier: BSD-3-Clause
// On which side of a line a point is, exactly; and, except for turnOf, never on the line: points
// are moved by symbolic infinitesimals (simulation of simplicity), so that no three are collinear
// and no two coincide or have the same height. Touching, overlapping and duplicate parts then need
// no special case.
#ifndef RectifiedTransport_ExactOrientation_h
#define RectifiedTransport_ExactOrientation_h

#include "Core/Geometry/Points.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace RectifiedTransport
{

// A point and its unique number, which determines how the point is moved.
struct NumberedPoint
{
  Point<2> X;
  std::int64_t Number;
};

// Whether a, b and c turn left, if floating point cannot tell.
bool turnsLeftExactly(const NumberedPoint& a, const NumberedPoint& b, const NumberedPoint& c);

// Twice the area of the triangle to rounding: 0 only if the points are collinear.
double exactDoubleArea(const Point<2>& a, const Point<2>& b, const Point<2>& c);

// Twice the area of the triangle a, b, c: above 0 if it turns left, below 0 if it turns right, 0 if
// the points are collinear. The sign is exact if products of coordinates neither overflow nor
// underflow.
double turnOf(const double* a, const double* b, const double* c);

// Twice the area of the triangle, and a bound of its error: above Shewchuk's 3 eps / 2.
inline double doubleArea(const Point<2>& a, const Point<2>& b, const Point<2>& c, double& error)
{
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  error = 4.0 * std::numeric_limits<double>::epsilon() * (std::abs(left) + std::abs(right));
  return left - right;
}

// Whether a, b and c turn left: by floating point where its error bound decides.
inline bool turnsLeft(const NumberedPoint& a, const NumberedPoint& b, const NumberedPoint& c)
{
  double error = 0.0;
  const double area = doubleArea(a.X, b.X, c.X, error);
  return std::abs(area) > error ? area > 0.0 : turnsLeftExactly(a, b, c);
}

// Whether a is higher than b. At equal heights, the smaller number has moved farther up.
inline bool isAbove(const NumberedPoint& a, const NumberedPoint& b)
{
  return a.X[1] != b.X[1] ? a.X[1] > b.X[1] : a.Number < b.Number;
}

// Whether ab and cd cross.
inline bool doCross(
  const NumberedPoint& a, const NumberedPoint& b, const NumberedPoint& c, const NumberedPoint& d)
{
  return turnsLeft(a, b, c) != turnsLeft(a, b, d) && turnsLeft(c, d, a) != turnsLeft(c, d, b);
}

} // namespace RectifiedTransport

#endif
