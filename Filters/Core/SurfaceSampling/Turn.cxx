// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SurfaceSampling/Turn.h"

#include <array>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// The exact sum of doubles, as doubles that do not overlap, the smallest first (Shewchuk,
// "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997).
class ExactSum
{
public:
  void Add(double value)
  {
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      // Knuth's sum of two, with its rounding error.
      const double sum = value + this->Parts[i];
      const double part = sum - value;
      this->Parts[i] = (value - (sum - part)) + (this->Parts[i] - part);
      value = sum;
    }
    this->Parts[this->Count++] = value;
  }

  void AddProduct(double a, double b)
  {
    const double product = a * b;
    this->Add(std::fma(a, b, -product));
    this->Add(product);
  }

  // Has the sign of the sum, as the largest part outweighs all others.
  double Rounded() const
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      sum += this->Parts[i];
    }
    return sum;
  }

private:
  std::array<double, 12> Parts;
  std::size_t Count = 0;
};

} // namespace

double turnOf(const double* a, const double* b, const double* c)
{
  // Of the value, in units of the sum of its terms' sizes (Shewchuk's ccwerrboundA).
  constexpr double half = 0.5 * std::numeric_limits<double>::epsilon();
  constexpr double bound = (3.0 + 16.0 * half) * half;
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double turn = left - right;
  if (std::abs(turn) > bound * (std::abs(left) + std::abs(right)))
  {
    return turn;
  }
  ExactSum sum;
  sum.AddProduct(a[0], b[1]);
  sum.AddProduct(-a[1], b[0]);
  sum.AddProduct(b[0], c[1]);
  sum.AddProduct(-b[1], c[0]);
  sum.AddProduct(c[0], a[1]);
  sum.AddProduct(-c[1], a[0]);
  return sum.Rounded();
}

} // namespace RectifiedTransport
