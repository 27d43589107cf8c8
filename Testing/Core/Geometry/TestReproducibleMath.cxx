// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/ReproducibleMath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{
namespace
{

TEST(ReproducibleMath, ExponentialAndLogarithm)
{
  constexpr double rounding = 1e-15;
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(naturalLogarithm(1.0), 0.0);
  for (double x = -40.0; x < 40.0; x += 0.0137)
  {
    EXPECT_NEAR(exponential(x) / std::exp(x), 1.0, rounding) << x;
    EXPECT_NEAR(naturalLogarithm(std::exp(x)), x, rounding * (1.0 + std::abs(x))) << x;
  }
}

TEST(ReproducibleMath, CosineAndSine)
{
  const double turn = 2.0 * std::acos(-1.0);
  for (const std::int64_t whole : { 1, 2, 3, 7, 8, 12, 1000, 4096, 99991 })
  {
    for (std::int64_t part = -whole; part <= 2 * whole; part += 1 + whole / 1000)
    {
      const auto [cosine, sine] = cosineAndSine(part, whole);
      // The library's angle is rounded, too, and large.
      const double angle = turn * static_cast<double>(part % whole) / static_cast<double>(whole);
      const double rounding = std::abs(angle) < 0.8 ? 3e-16 : 2e-15;
      EXPECT_NEAR(cosine, std::cos(angle), rounding) << part << " of " << whole;
      EXPECT_NEAR(sine, std::sin(angle), rounding) << part << " of " << whole;
      EXPECT_NEAR(cosine * cosine + sine * sine, 1.0, 5e-16) << part << " of " << whole;
      const auto [mirrored, negative] = cosineAndSine(-part, whole);
      EXPECT_EQ(mirrored, cosine) << part << " of " << whole;
      EXPECT_EQ(negative, -sine) << part << " of " << whole;
    }
  }
  constexpr std::int64_t large = std::int64_t{ 1 } << 59;
  EXPECT_EQ(cosineAndSine(0, 5).Cosine, 1.0);
  EXPECT_EQ(cosineAndSine(1, 4).Cosine, 0.0);
  EXPECT_EQ(cosineAndSine(1, 4).Sine, 1.0);
  EXPECT_EQ(cosineAndSine(large / 2, large).Cosine, -1.0);
  EXPECT_NEAR(cosineAndSine(1, 12).Sine, 0.5, 1e-16);
  EXPECT_NEAR(cosineAndSine(1, large).Sine * 0x1p59 / turn, 1.0, 1e-15);
}

TEST(ReproducibleMath, CubeRoot)
{
  for (double x = 1e-9; x < 1e9; x *= 1.7)
  {
    EXPECT_NEAR(cubeRoot(x) / std::cbrt(x), 1.0, 1e-15) << x;
  }
  EXPECT_EQ(cubeRoot(-1.0), 0.0);
}

} // namespace
} // namespace RectifiedTransport
