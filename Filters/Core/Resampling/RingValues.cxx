// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/RingValues.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace RectifiedTransport
{

RingValues::RingValues(const Rings& rings, std::int64_t ring, const double* values)
{
  const std::int64_t begin = rings.Begin(ring);
  const std::int64_t end = rings.Begin(ring + 1);
  if (begin == end)
  {
    return;
  }
  // The weight of a point is half of the length of its two edges, by the length of the ring: the
  // trapezoidal rule for means along the ring.
  std::vector<double> weights(static_cast<std::size_t>(end - begin), 0.0);
  double all = 0.0;
  for (std::int64_t i = begin; i < end; ++i)
  {
    const std::int64_t next = rings.Next(i);
    const double length =
      std::hypot(rings.At(next)[0] - rings.At(i)[0], rings.At(next)[1] - rings.At(i)[1]);
    // Each edge gives its length to both ends.
    weights[static_cast<std::size_t>(i - begin)] += length;
    weights[static_cast<std::size_t>(next - begin)] += length;
    all += 2.0 * length;
  }
  const auto weightOf = [&](std::int64_t i) {
    return all > 0.0 ? weights[static_cast<std::size_t>(i - begin)] / all
                     : 1.0 / static_cast<double>(end - begin);
  };
  this->Smallest = values[begin];
  this->Largest = this->Smallest;
  for (std::int64_t i = begin; i < end; ++i)
  {
    const double value = values[i];
    this->Value += weightOf(i) * value;
    this->Middle[0] += weightOf(i) * rings.At(i)[0];
    this->Middle[1] += weightOf(i) * rings.At(i)[1];
    this->Smallest = std::min(this->Smallest, value);
    this->Largest = std::max(this->Largest, value);
  }
  // The normal equations of the weighted least squares: with offsets from the weighted means, (xx
  // xy; xy yy) slope = right.
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  Point<2> right{ 0.0, 0.0 };
  for (std::int64_t i = begin; i < end; ++i)
  {
    const double x = rings.At(i)[0] - this->Middle[0];
    const double y = rings.At(i)[1] - this->Middle[1];
    // Deviations from the weighted means.
    const double off = values[i] - this->Value;
    xx += weightOf(i) * x * x;
    xy += weightOf(i) * x * y;
    yy += weightOf(i) * y * y;
    right[0] += weightOf(i) * x * off;
    right[1] += weightOf(i) * y * off;
  }
  // The points are on a line, nearly: the slope across it is undetermined, and the mean stays.
  constexpr double singular = 1e-12;
  // Cramer's rule for two unknowns.
  const double determinant = xx * yy - xy * xy;
  if (determinant > singular * (xx + yy) * (xx + yy))
  {
    this->Slope[0] = (right[0] * yy - right[1] * xy) / determinant;
    this->Slope[1] = (right[1] * xx - right[0] * xy) / determinant;
  }
}

double RingValues::At(const Point<2>& x) const
{
  const double value = this->Value + this->Slope[0] * (x[0] - this->Middle[0]) +
    this->Slope[1] * (x[1] - this->Middle[1]);
  return std::clamp(value, this->Smallest, this->Largest);
}

} // namespace RectifiedTransport
