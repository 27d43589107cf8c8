// SPDX-License-Identifier: BSD-3-Clause
// Tensor products of cubic Hermite polynomials on a box. The data at a corner are the function's
// mixed derivatives of order 0 or 1 along each axis: entry b is the derivative along the axes of
// the bits of b. Boxes that share a face and the data there join with continuous derivatives.
#ifndef RectifiedTransport_HermiteCell_h
#define RectifiedTransport_HermiteCell_h

#include "Core/Geometry/Points.h"

namespace RectifiedTransport
{

template <int Dimension>
constexpr int hermiteCorners = 1 << Dimension;

template <int Dimension, class Value = double>
using HermiteData = std::array<Value, hermiteCorners<Dimension>>;

// The values of two functions, which are interpolated as one: the weights are computed once.
struct ValuePair
{
  // Every processor has registers of this size.
  using Register = double __attribute__((vector_size(16)));

  ValuePair() = default;
  explicit ValuePair(const Register& both)
    : Both(both)
  {
  }
  ValuePair(double first, double second)
    : Both{ first, second }
  {
  }
  double First() const { return this->Both[0]; }
  double Second() const { return this->Both[1]; }
  friend ValuePair operator+(const ValuePair& a, const ValuePair& b)
  {
    return ValuePair(a.Both + b.Both);
  }
  friend ValuePair operator*(double a, const ValuePair& b) { return ValuePair(a * b.Both); }

  Register Both{};
};

// The data at the place `at`, in [0, 1], of a box with these sides. Corner c is at the upper end of
// the axes of the bits of c.
template <int Dimension, class Value>
HermiteData<Dimension, Value> interpolateHermite(
  const std::array<const Value*, hermiteCorners<Dimension>>& corners, const Point<Dimension>& at,
  const Point<Dimension>& sides)
{
  constexpr int count = hermiteCorners<Dimension>;
  // `value` has the cubic Hermite polynomials for the values h00, h01 and the slopes h10, h11 at
  // both ends, scaled by the side h; `slope` has their derivatives.
  Value data[count][count]; // corner, derivative
  for (int corner = 0; corner < count; ++corner)
  {
    for (int entry = 0; entry < count; ++entry)
    {
      data[corner][entry] = corners[corner][entry];
    }
  }
  // Axis by axis, the last first: the corners below `half` then hold the interpolation between both
  // ends.
  for (int axis = Dimension; axis-- > 0;)
  {
    const double t = at[axis];
    const double u = 1.0 - t;
    const double h = sides[axis];
    const double value[4] = { u * u * (1.0 + 2.0 * t), t * t * (3.0 - 2.0 * t), h * t * u * u,
      -h * t * t * u };
    const double rise = 6.0 * t * u / h;
    const double slope[4] = { -rise, rise, u * (1.0 - 3.0 * t), t * (3.0 * t - 2.0) };
    const int half = 1 << axis;
    for (int corner = 0; corner < half; ++corner)
    {
      for (int entry = 0; entry < count; ++entry)
      {
        if (entry & half)
        {
          continue;
        }
        const Value ends[4] = { data[corner][entry], data[corner + half][entry],
          data[corner][entry | half], data[corner + half][entry | half] };
        data[corner][entry] =
          value[0] * ends[0] + value[1] * ends[1] + value[2] * ends[2] + value[3] * ends[3];
        data[corner][entry | half] =
          slope[0] * ends[0] + slope[1] * ends[1] + slope[2] * ends[2] + slope[3] * ends[3];
      }
    }
  }
  HermiteData<Dimension, Value> result;
  for (int entry = 0; entry < count; ++entry)
  {
    result[entry] = data[0][entry];
  }
  return result;
}

} // namespace RectifiedTransport

#endif
