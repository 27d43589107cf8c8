// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/ReproducibleMath.h"

#include <gtest/gtest.h>

#include <cmath>

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
