// SPDX-License-Identifier: BSD-3-Clause
// What a kernel throws comes out of For; above all where memory runs out in the middle of a range.
#include "Core/Quality/NearestNeighbours.h"
#include "Core/SiteCells/EqualMasses/EqualizeSiteCells.h"
#include "Core/SiteCells/EqualMasses/SplitSharedPixels.h"
#include "FailingAllocations.h"
#include "TestFlow.h"
#include "TestSplat.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace RectifiedTransport
{
namespace
{

struct Thrown
{
  std::int64_t Range;
};

template <class ExecutorT>
void expectThrown(const ExecutorT& executor)
{
  for (const std::int64_t count : { 1, 7, 1000 })
  {
    std::atomic<std::int64_t> ranges{ 0 };
    try
    {
      executor.For(count, 1, [&](std::int64_t first, std::int64_t) {
        ++ranges;
        if (first % 5 == 0)
        {
          throw Thrown{ first };
        }
      });
      ADD_FAILURE() << "nothing came out";
    }
    catch (const Thrown& thrown)
    {
      EXPECT_EQ(thrown.Range % 5, 0);
    }
    EXPECT_GE(ranges, 1);
    EXPECT_LE(ranges, count);
  }
  // And none is left over for the next call.
  std::atomic<std::int64_t> sum{ 0 };
  executor.For(100, 7, [&sum](std::int64_t first, std::int64_t last) { sum += last - first; });
  EXPECT_EQ(sum, 100);
}

TEST(Executors, WhatAKernelThrowsComesOut)
{
  expectThrown(SerialExecutor());
  expectThrown(OpenMPExecutor());
}

TEST(Executors, NoMemoryForTheFlow)
{
  if (!canRunOut)
  {
    GTEST_SKIP() << "Memory does not run out under a sanitizer";
  }
  const TestDensity<2> density = discWithHole<2>({ 40, 30 });
  const Points<2> seeds = randomPoints<2>(density.Size, 3000);
  Points<2> positions(seeds.size());
  Points<2> paths(3 * seeds.size());
  const std::vector<double> times{ 0.2, 0.7, 1.0 };
  expectBadAlloc("the tables", [&]() { makeFlow(density); });
  const RectifiedFlow<2> flow = makeFlow(density);
  const FlowOptions few = steps(8);
  expectBadAlloc("forward", [&]() { flow.Forward(seeds, positions, few); });
  expectBadAlloc("at times", [&]() { flow.ForwardAt(seeds, times, paths, few); });
  expectBadAlloc("backward", [&]() { flow.Backward(seeds, positions, few); });
  expectBadAlloc("a lattice", [&]() {
    flow.Forward(FlowSeeds<2>::Lattice({ 60, 50 }), positions, few);
  });
  std::vector<std::int64_t> cells(3000);
  expectBadAlloc("cells", [&]() {
    flow.ForwardToCells(FlowSeeds<2>::Lattice({ 60, 50 }), cells.data(), few);
  });
}

// What is made for a run alone is said to be so.
TEST(Executors, NoMemoryForAFlowMap)
{
  if (!canRunOut)
  {
    GTEST_SKIP() << "Memory does not run out under a sanitizer";
  }
  const TestDensity<2> density = discWithHole<2>({ 160, 130 });
  const Points<2> seeds = randomPoints<2>(density.Size, 10);
  Points<2> positions(seeds.size());
  const RectifiedFlow<2> flow = makeFlow(density);
  const std::int64_t tables = flow.MemorySize();
  bool isNamed = false;
  expectBadAlloc("with maps", [&]() {
    try
    {
      FlowOptions options = with(FlowMaps::On);
      options.NumberOfSteps = 32;
      flow.Forward(seeds, positions, options);
    }
    catch (const NoMemoryForFlowMap& map)
    {
      EXPECT_EQ(flow.MemorySize(), tables);
      EXPECT_GT(map.MemorySize(), 1e4);
      isNamed = true;
      throw;
    }
  });
  EXPECT_TRUE(isNamed);
}

TEST(Executors, NoMemoryForTheRest)
{
  if (!canRunOut)
  {
    GTEST_SKIP() << "Memory does not run out under a sanitizer";
  }
  const GridSize<3> cells{ 9, 8, 7 };
  std::vector<double> values(504);
  const Points<3> points = randomPoints<3>(cells, 4000);
  std::vector<double> distances(points.size());
  expectBadAlloc("neighbours", [&]() { nearestDistances(points, distances.data()); });
  for (const SplatKernel kernel : allKernels)
  {
    const SplatParticles<3, double> particles{ points, nullptr, 1.0, identityMap<3>() };
    SplatOptions options;
    options.Kernel = kernel;
    expectBadAlloc(
      "a splat", [&]() { splatMass<3, double>(particles, cells, options, 1.0, values.data()); });
  }

  const GridSize<2> size{ 40, 30 };
  const Points<2> places = randomPoints<2>(size, 50);
  const SiteDensity<2> sites(size, places);
  std::vector<std::int64_t> owners(1200, 0);
  expectBadAlloc("a balance", [&]() {
    std::fill(owners.begin(), owners.end(), 0);
    equalizeSiteCells<2>(sites, { 1.0, 1.0 }, owners.data());
  });
}

} // namespace
} // namespace RectifiedTransport
