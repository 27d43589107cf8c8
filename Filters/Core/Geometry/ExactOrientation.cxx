// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/ExactOrientation.h"

#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// A sum without rounding: of parts that do not overlap, the last the largest (Shewchuk, "Adaptive
// Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997).
class ExactParts
{
public:
  void Add(double value)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      const double part = this->Parts[i];
      const double sum = value + part;
      const double other = sum - value;
      const double rest = (value - (sum - other)) + (part - other);
      if (rest != 0.0)
      {
        this->Parts[kept++] = rest;
      }
      value = sum;
    }
    if (value != 0.0)
    {
      this->Parts[kept++] = value;
    }
    this->Count = kept;
  }

  void AddProduct(double a, double b)
  {
    const double product = a * b;
    this->Add(std::fma(a, b, -product));
    this->Add(product);
  }

  // To rounding; 0 only if it is.
  double Sum() const
  {
    return std::accumulate(
      this->Parts.begin(), this->Parts.begin() + static_cast<std::ptrdiff_t>(this->Count), 0.0);
  }

private:
  std::array<double, 16> Parts;
  std::size_t Count = 0;
};

} // namespace

double exactDoubleArea(const Point<2>& a, const Point<2>& b, const Point<2>& c)
{
  ExactParts sum;
  const std::array<const Point<2>*, 4> around{ &a, &b, &c, &a };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point<2>& p = *around[i];
    const Point<2>& q = *around[i + 1];
    sum.AddProduct(p[0], q[1]);
    sum.AddProduct(-p[1], q[0]);
  }
  return sum.Sum();
}

double turnOf(const double* a, const double* b, const double* c)
{
  // Of the value, in units of the sum of its terms' sizes (Shewchuk's ccwerrboundA).
  constexpr double half = 0.5 * std::numeric_limits<double>::epsilon();
  constexpr double bound = (3.0 + 16.0 * half) * half;
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double turn = left - right;
  return std::abs(turn) > bound * (std::abs(left) + std::abs(right))
    ? turn
    : exactDoubleArea({ a[0], a[1] }, { b[0], b[1] }, { c[0], c[1] });
}

bool turnsLeftExactly(const NumberedPoint& a, const NumberedPoint& b, const NumberedPoint& c)
{
  const double area = exactDoubleArea(a.X, b.X, c.X);
  if (area != 0.0)
  {
    return area > 0.0;
  }
  std::array<const NumberedPoint*, 3> p{ &a, &b, &c };
  bool isEven = true;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (p[i]->Number > p[j]->Number)
    {
      std::swap(p[i], p[j]);
      isEven = !isEven;
    }
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  // A point of a smaller number moves by far more than those of larger ones, and along y by far
  // more than along x: the signs of the area's derivatives in this order.
  const Point<2>& x = p[0]->X;
  const Point<2>& y = p[1]->X;
  const Point<2>& z = p[2]->X;
  const bool isLeft = z[0] != y[0] ? z[0] > y[0]
    : y[1] != z[1]                 ? y[1] > z[1]
    : x[0] != z[0]                 ? x[0] > z[0]
                                   : true;
  return isLeft == isEven;
}

} // namespace RectifiedTransport
