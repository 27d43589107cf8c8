// SPDX-License-Identifier: BSD-3-Clause
// Reductions by chunks: each chunk once and as it was cut, parts in order, whatever the executor.
#include "Core/Parallel/Reduction.h"
#include "Core/Parallel/Stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <new>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// Gives several grains at a time, the last ones first.
class LongRanges final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override
  {
    const std::int64_t length = 3 * grain;
    for (std::int64_t range = (count + length - 1) / length; range-- > 0;)
    {
      kernel(range * length, std::min((range + 1) * length, count));
    }
  }
  int Concurrency() const override { return 5; }
};

const SerialExecutor serial;
const OpenMPExecutor threads;
const LongRanges longRanges;
const Executor* const executors[] = { &serial, &threads, &longRanges };

// Numbers whose sum depends on its order.
double term(std::int64_t i)
{
  return std::ldexp(std::sin(static_cast<double>(i)), static_cast<int>(i % 60));
}

double sumOf(std::int64_t first, std::int64_t last)
{
  double sum = 0.0;
  for (std::int64_t i = first; i < last; ++i)
  {
    sum += term(i);
  }
  return sum;
}

TEST(Reduction, SumOfTheChunksInOrder)
{
  for (const std::int64_t count : { 0, 1, 99, 100, 101, 1000000 })
  {
    double expected = 0.0;
    for (std::int64_t first = 0; first < count; first += 100)
    {
      expected += sumOf(first, std::min<std::int64_t>(first + 100, count));
    }
    for (const Executor* executor : executors)
    {
      Progress progress(*executor);
      EXPECT_EQ(reduceChunks(progress, count, 100, 0.0, sumOf, std::plus<>()), expected) << count;
    }
  }
}

// A combination that keeps all that it is given.
TEST(Reduction, EachChunkOnce)
{
  const auto chunk = [](std::int64_t first, std::int64_t last) {
    return std::to_string(first) + "-" + std::to_string(last) + " ";
  };
  for (const Executor* executor : executors)
  {
    Progress progress(*executor);
    const auto chunks = [&](std::int64_t count) {
      return reduceChunks(progress, count, 4, std::string(), chunk, std::plus<>());
    };
    EXPECT_EQ(chunks(18), "0-4 4-8 8-12 12-16 16-18 ");
    EXPECT_EQ(chunks(3), "0-3 ");
    EXPECT_EQ(chunks(0), "");
  }
}

TEST(Reduction, Extremum)
{
  const double nothing = -std::numeric_limits<double>::infinity();
  const auto largest = [](std::int64_t first, std::int64_t last) {
    double found = term(first);
    for (std::int64_t i = first; i < last; ++i)
    {
      found = std::max(found, term(i));
    }
    return found;
  };
  const auto larger = [](double a, double b) { return std::max(a, b); };
  for (const Executor* executor : executors)
  {
    Progress progress(*executor);
    EXPECT_EQ(reduceChunks(progress, 5000, 7, nothing, largest, larger), largest(0, 5000));
    EXPECT_EQ(reduceChunks(progress, 0, 7, nothing, largest, larger), nothing);
  }
}

TEST(Reduction, ReportsAndStops)
{
  std::vector<double> heard;
  const Context context(
    threads, [&heard](double done) { heard.push_back(done); },
    [&heard]() { return !heard.empty() && heard.back() > 0.6; });
  Progress progress(context);
  Stages stages(progress, { { "whole", 1 }, { "cancelled", 1 } });
  Progress& whole = stages["whole"];
  EXPECT_EQ(reduceChunks(whole, 1 << 20, 1024, 0.0, sumOf, std::plus<>()),
    reduceChunks(whole, 1 << 20, 1024, 0.0, sumOf, std::plus<>()));
  EXPECT_EQ(heard.back(), 0.5);
  EXPECT_THROW(
    reduceChunks(stages["cancelled"], 1 << 24, 1024, 0.0, sumOf, std::plus<>()), Cancelled);
}

TEST(Reduction, WhatAKernelThrowsComesOut)
{
  const auto fail = [](std::int64_t first, std::int64_t) {
    return first < 500 ? 1.0 : throw std::bad_alloc();
  };
  for (const Executor* executor : { executors[0], executors[1] })
  {
    Progress progress(*executor);
    EXPECT_THROW(reduceChunks(progress, 1000, 10, 0.0, fail, std::plus<>()), std::bad_alloc);
  }
}

} // namespace
} // namespace RectifiedTransport
