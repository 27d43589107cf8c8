// SPDX-License-Identifier: BSD-3-Clause
// Means of positions: the ends to the bit, what has no weight is not read, ranges are independent.
#include "Core/Flow/WeightedMean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace RectifiedTransport
{
namespace
{

using Points = std::vector<Point<3>>;

// More coordinates than the blocks that the mean is taken in, and no multiple of them.
constexpr std::int64_t count = 1700;

Points randomPoints(std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  Points points(count);
  for (Point<3>& point : points)
  {
    for (double& coordinate : point)
    {
      coordinate = 1e3 * (static_cast<double>(engine() >> 11) * 0x1p-53 - 0.4);
    }
  }
  return points;
}

Points meanOf(const std::vector<WeightedPositions>& parts)
{
  Points mean(count, { -7.0, -7.0, -7.0 });
  writeWeightedMean(parts, 0, count, mean);
  return mean;
}

TEST(WeightedMean, EndsAreExact)
{
  const Points a = randomPoints(1);
  const Points b = randomPoints(2);
  EXPECT_EQ(meanOf({ { a, 1.0 }, { b, 0.0 } }), a);
  EXPECT_EQ(meanOf({ { a, 0.0 }, { b, 1.0 } }), b);
  EXPECT_EQ(meanOf({ { a, 1.0 } }), a);
}

TEST(WeightedMean, WithoutWeightIsNotRead)
{
  const Points a = randomPoints(1);
  const Points b = randomPoints(2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Points none(count, { nan, nan, nan });
  const Points expected = meanOf({ { a, 0.25 }, { b, 0.75 } });
  EXPECT_EQ(meanOf({ { none, 0.0 }, { a, 0.25 }, { {}, 0.0 }, { b, 0.75 } }), expected);
}

TEST(WeightedMean, IsTheSum)
{
  const Points a = randomPoints(1);
  const Points b = randomPoints(2);
  const Points c = randomPoints(3);
  const Points mean = meanOf({ { a, 0.2 }, { b, 0.5 }, { c, 0.3 } });
  for (std::size_t i = 0; i < mean.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(mean[i][axis], 0.2 * a[i][axis] + 0.5 * b[i][axis] + 0.3 * c[i][axis], 1e-12);
    }
  }
}

// Each range writes its own points, the same as of one range of all, and no others.
TEST(WeightedMean, Ranges)
{
  const Points a = randomPoints(1);
  const Points b = randomPoints(2);
  const std::vector<WeightedPositions> parts = { { a, 0.3 }, { b, 0.7 } };
  const Points expected = meanOf(parts);
  const std::int64_t ends[] = { 0, 1, 230, 571, 572, 1300, count };
  const Point<3> untouched = { -7.0, -7.0, -7.0 };
  Points mean(count, untouched);
  for (std::size_t i = 0; i + 1 < std::size(ends); ++i)
  {
    writeWeightedMean(parts, ends[i], ends[i + 1], mean);
    if (ends[i + 1] < count)
    {
      EXPECT_EQ(mean[static_cast<std::size_t>(ends[i + 1])], untouched);
    }
  }
  EXPECT_EQ(mean, expected);
}

} // namespace
} // namespace RectifiedTransport
