// SPDX-License-Identifier: BSD-3-Clause
// On which side of a line a point is, against whole numbers.
#include "Core/Geometry/ExactOrientation.h"

#include "Core/Geometry/Points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace RectifiedTransport
{
namespace
{

int signOf(double value)
{
  return (value > 0.0) - (value < 0.0);
}

double turn(const Point<2>& a, const Point<2>& b, const Point<2>& c)
{
  return turnOf(a.data(), b.data(), c.data());
}

// Points of a lattice about a line, moved by all that rounding would hide: a line through (0.5,0.5)
// and (12,12) in steps of 2^-53 has these signs (Kettner et al. 2008, "Classroom examples of
// robustness problems").
TEST(Turn, NearALine)
{
  const Point<2> b{ 12.0, 12.0 };
  const Point<2> c{ 24.0, 24.0 };
  const double step = std::ldexp(1.0, -53);
  for (int i = 0; i < 64; ++i)
  {
    for (int j = 0; j < 64; ++j)
    {
      const Point<2> a{ 0.5 + i * step, 0.5 + j * step };
      const int expected = signOf(a[1] - a[0]);
      ASSERT_EQ(signOf(turn(a, b, c)), expected) << i << " " << j;
      ASSERT_EQ(signOf(turn(b, c, a)), expected);
      ASSERT_EQ(signOf(turn(c, b, a)), -expected);
    }
  }
}

TEST(Turn, WholeNumbers)
{
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::int64_t> any(0, std::int64_t{ 1 } << 30);
  std::uniform_int_distribution<std::int64_t> few(-1, 1);
  std::int64_t zeros = 0;
  for (int k = 0; k < 100000; ++k)
  {
    const std::int64_t a[2] = { any(random), any(random) };
    const std::int64_t b[2] = { 2 * (any(random) / 2) - a[0] % 2, any(random) };
    // Near the middle of a and b, or anywhere.
    const std::int64_t near[2] = { (a[0] + b[0]) / 2 + few(random), (a[1] + b[1]) / 2 };
    const std::int64_t far[2] = { any(random), any(random) };
    const std::int64_t* c = k % 2 ? near : far;
    const std::int64_t exact =
      (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]); // up to 2^61
    const auto scaled = [](const std::int64_t* x) {
      return Point<2>{ std::ldexp(static_cast<double>(x[0]), -30),
        std::ldexp(static_cast<double>(x[1]), -30) };
    };
    const double found = turn(scaled(a), scaled(b), scaled(c));
    ASSERT_EQ(signOf(found), (exact > 0) - (exact < 0));
    ASSERT_NEAR(found, std::ldexp(static_cast<double>(exact), -60), 1e-15);
    zeros += exact == 0;
  }
  EXPECT_GT(zeros, 1000);
}

} // namespace
} // namespace RectifiedTransport
