// SPDX-License-Identifier: BSD-3-Clause
// Sums of integers: the same for every number of threads, each of which has an array of its own.
#include "Core/OptimalMap/Nodes/IntegerSums.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
namespace
{

TEST(IntegerSums, DoNotDependOnTheThreads)
{
  constexpr std::int64_t count = 7;
  constexpr std::int64_t items = 10003;
  std::vector<std::int64_t> expected(count, 0);
  for (std::int64_t item = 0; item < items; ++item)
  {
    expected[static_cast<std::size_t>(item % count)] += item - 400;
  }
  for (const int threads : { 1, 2, 5, 20 })
  {
    const ThreadsExecutor executor(threads);
    Progress progress{ Context(executor) };
    IntegerSums sums(count, items, progress);
    const auto add = [&]() {
      progress.For(items, 50, [&](std::int64_t first, std::int64_t last) {
        const IntegerSums::Part part(sums);
        for (std::int64_t item = first; item < last; ++item)
        {
          part.Values()[item % count] += item - 400;
        }
      });
    };
    add();
    std::vector<std::int64_t> found(count, 0);
    sums.Finish(progress,
      [&](std::int64_t i, std::int64_t sum) { found[static_cast<std::size_t>(i)] = sum; });
    EXPECT_EQ(found, expected) << threads;
    add(); // Finish has set all to 0
    const LargeBuffer<std::int64_t> released = sums.Release(progress);
    EXPECT_EQ(std::vector<std::int64_t>(released.data(), released.data() + count), expected);
  }
}

TEST(IntegerSums, GiveThreadsArraysOfTheirOwn)
{
  const ThreadsExecutor executor(3);
  const Progress progress{ Context(executor) };
  IntegerSums sums(10, 1000, progress);
  const IntegerSums::Part first(sums);
  const IntegerSums::Part second(sums);
  EXPECT_NE(first.Values(), second.Values());
  EXPECT_EQ(std::count(first.Values(), first.Values() + 10, 0), 10);
}

TEST(IntegerSums, HaveMoreArraysWhereTheyPay)
{
  EXPECT_EQ(IntegerSums::ArraysFor(1000, 100, 64), 1);
  EXPECT_EQ(IntegerSums::ArraysFor(1000, 500, 64), 3);
  EXPECT_EQ(IntegerSums::ArraysFor(1000, 1000000, 64), mostArraysOfSums);
  EXPECT_EQ(IntegerSums::ArraysFor(1000, 1000000, 2), 2);
}

TEST(IntegerSums, RoundToTheNearest)
{
  EXPECT_EQ(toInteger(2.4), 2);
  EXPECT_EQ(toInteger(2.6), 3);
  EXPECT_EQ(toInteger(-2.4), -2);
  EXPECT_EQ(toInteger(-2.6), -3);
  EXPECT_EQ(toInteger(integerUnit), std::int64_t{ 1 } << 62);
}

} // namespace
} // namespace RectifiedTransport
