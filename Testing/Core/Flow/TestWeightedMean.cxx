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

using Numbers = std::vector<double>;

// More than the blocks that the mean is taken in, and no multiple of them.
constexpr std::int64_t count = 5000;

Numbers randomNumbers(std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  Numbers numbers(count);
  for (double& number : numbers)
  {
    number = 1e3 * (static_cast<double>(engine() >> 11) * 0x1p-53 - 0.4);
  }
  return numbers;
}

Numbers meanOf(const std::vector<WeightedPositions>& parts)
{
  Numbers mean(count, -7.0);
  writeWeightedMean(parts, 0, count, mean.data());
  return mean;
}

TEST(WeightedMean, EndsAreExact)
{
  const Numbers a = randomNumbers(1);
  const Numbers b = randomNumbers(2);
  EXPECT_EQ(meanOf({ { a.data(), 1.0 }, { b.data(), 0.0 } }), a);
  EXPECT_EQ(meanOf({ { a.data(), 0.0 }, { b.data(), 1.0 } }), b);
  EXPECT_EQ(meanOf({ { a.data(), 1.0 } }), a);
}

TEST(WeightedMean, WithoutWeightIsNotRead)
{
  const Numbers a = randomNumbers(1);
  const Numbers b = randomNumbers(2);
  const Numbers none(count, std::numeric_limits<double>::quiet_NaN());
  const Numbers expected = meanOf({ { a.data(), 0.25 }, { b.data(), 0.75 } });
  EXPECT_EQ(
    meanOf({ { none.data(), 0.0 }, { a.data(), 0.25 }, { nullptr, 0.0 }, { b.data(), 0.75 } }),
    expected);
}

TEST(WeightedMean, IsTheSum)
{
  const Numbers a = randomNumbers(1);
  const Numbers b = randomNumbers(2);
  const Numbers c = randomNumbers(3);
  const Numbers mean = meanOf({ { a.data(), 0.2 }, { b.data(), 0.5 }, { c.data(), 0.3 } });
  for (std::size_t i = 0; i < mean.size(); ++i)
  {
    EXPECT_NEAR(mean[i], 0.2 * a[i] + 0.5 * b[i] + 0.3 * c[i], 1e-12);
  }
}

// Each range writes its own numbers, the same as of one range of all, and no others.
TEST(WeightedMean, Ranges)
{
  const Numbers a = randomNumbers(1);
  const Numbers b = randomNumbers(2);
  const std::vector<WeightedPositions> parts = { { a.data(), 0.3 }, { b.data(), 0.7 } };
  const Numbers expected = meanOf(parts);
  const std::int64_t ends[] = { 0, 1, 700, 1724, 1725, 4000, count };
  Numbers mean(count, -7.0);
  for (std::size_t i = 0; i + 1 < std::size(ends); ++i)
  {
    writeWeightedMean(parts, ends[i], ends[i + 1], mean.data());
    if (ends[i + 1] < count)
    {
      EXPECT_EQ(mean[static_cast<std::size_t>(ends[i + 1])], -7.0);
    }
  }
  EXPECT_EQ(mean, expected);
}

} // namespace
} // namespace RectifiedTransport
