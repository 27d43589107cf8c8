// SPDX-License-Identifier: BSD-3-Clause
// Partitions into cells of equal mass on large grids and on threads, and their cancellation.
#include "Core/PowerCells/EqualMassPartition.h"

#include "CountingExecutor.h"
#include "RecordingContext.h"
#include "TestPowerCells.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace RectifiedTransport
{
namespace
{

constexpr double tolerance = EqualMassPartition::massTolerance;

// Half a million cells in a row or a column: what is known of the last of them has all digits.
TEST(EqualMassPartitionRun, LongStrips)
{
  constexpr std::int64_t length = 500000;
  constexpr std::int64_t count = 250;
  for (const std::size_t axis : { 0u, 1u })
  {
    GridSize<2> size = { 1, 1 };
    size[axis] = length;
    const TestDensity<2> density =
      sampleDensity<2>(size, [axis](const Point<2>& p) { return 0.5 + p[axis] * (2.0 - p[axis]); });
    Points<2> sites(count, evenPoint<2>(0.5));
    for (std::size_t i = 0; i < count; ++i)
    {
      sites[i][axis] = 2000.0 * (static_cast<double>(i) + 0.25 + 0.1 * static_cast<double>(i % 5));
    }
    const EqualMassPartition partition = solved(density, sites);
    for (const std::size_t i : { std::size_t{ 0 }, std::size_t{ count - 2 } })
    {
      const Points<2> cell = cornersOf(partition.Diagram()[static_cast<std::int64_t>(i)]);
      const auto range = std::minmax_element(cell.begin(), cell.end(),
        [axis](const Point<2>& a, const Point<2>& b) { return a[axis] < b[axis]; });
      GridSize<2> first{};
      first[axis] = static_cast<std::int64_t>((*range.first)[axis]);
      GridSize<2> window = { 1, 1 };
      window[axis] = static_cast<std::int64_t>((*range.second)[axis]) + 1 - first[axis];
      const PolygonMoments expected =
        windowMoments(density, { 1.0, 1.0 }, count, first, window, cell);
      EXPECT_NEAR(expected.Mass, 1.0, tolerance);
      Point<2> site = sites[i];
      site[axis] -= static_cast<double>(first[axis]);
      const auto found = static_cast<std::int64_t>(i);
      const double cost = costOf(expected, site);
      EXPECT_NEAR(partition.Cost(found), cost, 1e-11 * cost);
      EXPECT_NEAR(partition.Centroid(found)[axis] - static_cast<double>(first[axis]),
        expected.First[axis] / expected.Mass, 1e-12 * 2000.0);
      EXPECT_NEAR(partition.Centroid(found)[1 - axis], 0.5, 1e-12);
    }
  }
}

TEST(EqualMassPartitionRun, ThreadsDoNotMatter)
{
  const TestDensity<2> density = spots({ 40, 40 });
  const Points<2> sites = randomPoints<2>(density.Size, 500, 6);
  const auto result = [&](const Executor& threads) {
    const EqualMassPartition partition = solved(density, sites, { 1.0, 1.0 }, threads);
    std::vector<Points<2>> all;
    for (std::int64_t i = 0; i < 500; ++i)
    {
      all.push_back(cornersOf(partition.Diagram()[i]));
      all.push_back({ partition.Centroid(i), { partition.Cost(i), 0.0 } });
    }
    return all;
  };
  const auto serial = result(SerialExecutor());
  for (const int threads : { 1, 2, 3 })
  {
    EXPECT_EQ(result(ThreadsExecutor(threads)), serial) << threads;
  }
}

// Cutting the cells and integrating along their sides; all else is short.
TEST(EqualMassPartitionRun, HasFewLoopsForThreads)
{
  const TestDensity<2> density = spots({ 40, 40 });
  const CountingExecutor threads;
  const EqualMassPartition partition =
    solved(density, randomPoints<2>(density.Size, 400, 6), { 1.0, 1.0 }, threads);
  EXPECT_GT(partition.NewtonSteps(), 5);
  EXPECT_LT(threads.Calls, 15 * partition.NewtonSteps());
}

TEST(EqualMassPartitionRun, IsCancelled)
{
  const TestDensity<2> density = spots({ 40, 40 });
  const Points<2> sites = randomPoints<2>(density.Size, 600, 6);
  EqualMassPartition partition = makePartition(density, sites.size());
  const SerialExecutor threads;
  for (const int queries : { 0, 3 })
  {
    RecordingContext recording(threads);
    recording.MaximumQueries = queries;
    EXPECT_THROW(solve(partition, sites, recording.Context()), Cancelled);
  }
  EXPECT_TRUE(solve(partition, sites));
}

// Each of Newton's steps polls many times, most of all in its linear system.
TEST(EqualMassPartitionRun, IsCancelledAnywhere)
{
  const TestDensity<2> density = uniformDensity<2>({ 40, 40 });
  const Points<2> sites = randomPoints<2>(density.Size, 2000, 6);
  const SerialExecutor threads;
  RecordingContext whole(threads);
  EqualMassPartition partition = makePartition(density, sites.size());
  ASSERT_TRUE(solve(partition, sites, whole.Context()));
  EXPECT_GT(whole.Queries, 25 * partition.NewtonSteps());
  for (int i = 0; i < 8; ++i)
  {
    RecordingContext stopped(threads);
    stopped.MaximumQueries = whole.Queries * i / 16;
    EqualMassPartition other = makePartition(density, sites.size());
    EXPECT_THROW(solve(other, sites, stopped.Context()), Cancelled);
    EXPECT_EQ(stopped.Queries, stopped.MaximumQueries + 1);
  }
}

} // namespace
} // namespace RectifiedTransport
