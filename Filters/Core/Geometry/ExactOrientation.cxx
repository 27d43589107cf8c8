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

// A sum without rounding, as an expansion: parts that do not overlap, the last one the largest
// (Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
// 1997).
class ExactParts
{
public:
  // Grow-expansion: the error of each addition is computed exactly by Knuth's two-sum, and becomes
  // a part of its own.
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

  // a b is the sum of its rounded value and the error, which a fused multiply-add gives exactly.
  void AddProduct(double a, double b)
  {
    const double product = a * b;
    this->Add(std::fma(a, b, -product));
    this->Add(product);
  }

  // The sum to rounding; it is 0 only if the exact sum is.
  double Sum() const
  {
    return std::accumulate(
      this->Parts.begin(), this->Parts.begin() + static_cast<std::ptrdiff_t>(this->Count), 0.0);
  }

private:
  // Six products have two parts each; every addition adds at most one part.
  std::array<double, 16> Parts;
  std::size_t Count = 0;
};

} // namespace

double exactDoubleArea(const Point<2>& a, const Point<2>& b, const Point<2>& c)
{
  // Twice the area is the sum over the sides pq of p_x q_y - p_y q_x.
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
  // The error of the value, relative to the sum of the absolute values of its terms (Shewchuk's
  // ccwerrboundA).
  constexpr double half = 0.5 * std::numeric_limits<double>::epsilon();
  constexpr double bound = (3.0 + 16.0 * half) * half;
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double turn = left - right;
  return std::abs(turn) > bound * (std::abs(left) + std::abs(right))
    ? turn
    : exactDoubleArea({ a[0], a[1] }, { b[0], b[1] }, { c[0], c[1] });
}

// Sorts the three points by their numbers, and notes whether the permutation is even: the sign of
// the area changes with each exchange.
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
  // A point of a smaller number moves far more than those of larger ones, and far more along y than
  // along x. The first derivative of the area in this order that is not 0 decides: z_x - y_x by
  // x_y, y_y - z_y by x_x, x_x - z_x by y_y. If all three are 0, a second derivative decides, which
  // is a constant.
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
