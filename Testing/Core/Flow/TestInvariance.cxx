// SPDX-License-Identifier: BSD-3-Clause
// A particle's result depends on its seed and the density alone, to the last bit: not on who runs
// the ranges, how many threads there are, which other seeds are there or in what order.
#include "TestDimensions.h"
#include "TestFlow.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <thread>
#include <utility>

namespace RectifiedTransport
{
namespace
{

// Runs the ranges from the last to the first, every one as short as the grain allows.
class ReversingExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override
  {
    const std::int64_t step = std::max<std::int64_t>(grain, 1);
    for (std::int64_t first = (count - 1) / step * step; first >= 0; first -= step)
    {
      kernel(first, std::min(first + step, count));
    }
  }
  int Concurrency() const override { return 1; }
};

// Splits the ranges unevenly over threads of its own.
class UnevenExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override
  {
    const std::int64_t step = std::max<std::int64_t>(grain, 1);
    const std::int64_t cut = std::min(count, (count / step / 3 + 1) * step);
    std::thread other([&]() { kernel(0, cut); });
    for (std::int64_t first = cut; first < count; first += 2 * step)
    {
      kernel(first, std::min(first + 2 * step, count));
    }
    other.join();
  }
  int Concurrency() const override { return 5; }
};

std::vector<FlowOptions> allOptions()
{
  std::vector<FlowOptions> all;
  for (const Integrator method : AllIntegrators)
  {
    all.push_back(with(FlowMaps::Off, steps(20, method)));
  }
  all.push_back(with(FlowMaps::On, steps(20)));
  return all;
}

std::string describe(const FlowOptions& options)
{
  return nameOf(options.Integrator) + ", " + nameOf(options.Maps);
}

template <class T>
using Invariance = DimensionTest<T>;
TYPED_TEST_SUITE(Invariance, Dimensions);

// Empty regions, so that particles are redone, and sides that need coarse levels.
template <int Dimension>
TestDensity<Dimension> densityWithVoids()
{
  return discWithHole<Dimension>(sizeFor<Dimension>({ 1000 }, { 190, 137 }, { 80, 90, 71 }));
}

// Not a multiple of any block or slice.
constexpr std::size_t ParticleCount = 2011;

// Else the tests with flow maps would have none.
TYPED_TEST(Invariance, HasFlowMaps)
{
  constexpr int Dimension = TypeParam::value;
  const TestDensity<Dimension> density = densityWithVoids<Dimension>();
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, ParticleCount);
  for (const int count : { 20, 32 })
  {
    const FlowOptions on = with(FlowMaps::On, steps(count));
    const FlowOptions off = with(FlowMaps::Off, steps(count));
    EXPECT_NE(Dimension == 1,
      !sameBits<Dimension>(runForward(flow, seeds, on), runForward(flow, seeds, off)));
    EXPECT_NE(Dimension == 1,
      !sameBits<Dimension>(runBackward(flow, seeds, on), runBackward(flow, seeds, off)));
  }
}

TYPED_TEST(Invariance, ExecutorsAndThreads)
{
  constexpr int Dimension = TypeParam::value;
  const TestDensity<Dimension> density = densityWithVoids<Dimension>();
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, ParticleCount);
  const RectifiedFlow<Dimension> reference(density.Source(), SerialExecutor());

  std::vector<std::pair<std::string, std::unique_ptr<Executor>>> executors;
  executors.emplace_back("OpenMP, 1 thread", std::make_unique<ThreadsExecutor>(1));
  executors.emplace_back("OpenMP, 2 threads", std::make_unique<ThreadsExecutor>(2));
  executors.emplace_back("OpenMP, 3 threads", std::make_unique<ThreadsExecutor>(3));
  executors.emplace_back("reversing", std::make_unique<ReversingExecutor>());
  executors.emplace_back("uneven", std::make_unique<UnevenExecutor>());
  for (const auto& [name, executor] : executors)
  {
    const RectifiedFlow<Dimension> flow(density.Source(), *executor);
    EXPECT_EQ(flow.Total(), reference.Total()) << name;
    EXPECT_EQ(flow.Centroid(), reference.Centroid()) << name;
    for (const FlowOptions& options : allOptions())
    {
      EXPECT_TRUE(sameBits<Dimension>(runForward(flow, seeds, options, *executor),
        runForward(reference, seeds, options, SerialExecutor())))
        << name << ", forward, " << describe(options);
      EXPECT_TRUE(sameBits<Dimension>(runBackward(flow, seeds, options, *executor),
        runBackward(reference, seeds, options, SerialExecutor())))
        << name << ", backward, " << describe(options);
    }
  }
}

template <int Dimension>
Points<Dimension> pick(const Points<Dimension>& points, const std::vector<std::size_t>& indices)
{
  Points<Dimension> picked;
  for (const std::size_t index : indices)
  {
    picked.push_back(points[index]);
  }
  return picked;
}

TYPED_TEST(Invariance, OrderAndSubsetOfTheSeeds)
{
  constexpr int Dimension = TypeParam::value;
  const TestDensity<Dimension> density = densityWithVoids<Dimension>();
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, ParticleCount);

  std::vector<std::vector<std::size_t>> choices(4);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    choices[0].push_back(seeds.size() - 1 - i);
    choices[1].push_back(i * 997 % seeds.size());
    if (i % 3 == 1)
    {
      choices[2].push_back(i);
    }
  }
  choices[3] = { 1234 };
  choices.push_back({ 5, 5, 5, 77, 5, 2010, 77 });

  for (const TableLookup lookup : { TableLookup::Interpolated, TableLookup::Nearest })
  {
    for (FlowOptions options : allOptions())
    {
      options.Lookup = lookup;
      const Points<Dimension> all = runForward(flow, seeds, options);
      const Points<Dimension> allBack = runBackward(flow, seeds, options);
      for (const std::vector<std::size_t>& choice : choices)
      {
        const Points<Dimension> chosen = pick<Dimension>(seeds, choice);
        EXPECT_TRUE(
          sameBits<Dimension>(runForward(flow, chosen, options), pick<Dimension>(all, choice)))
          << describe(options) << ", forward, " << choice.size() << " seeds";
        EXPECT_TRUE(
          sameBits<Dimension>(runBackward(flow, chosen, options), pick<Dimension>(allBack, choice)))
          << describe(options) << ", backward, " << choice.size() << " seeds";
      }
    }
  }
}

TYPED_TEST(Invariance, InPlace)
{
  constexpr int Dimension = TypeParam::value;
  const TestDensity<Dimension> density = densityWithVoids<Dimension>();
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, ParticleCount);
  Points<Dimension> points = seeds;
  flow.Forward(points, points);
  EXPECT_TRUE(sameBits<Dimension>(points, runForward(flow, seeds)));
  const Points<Dimension> positions = points;
  flow.Backward(points, points);
  EXPECT_TRUE(sameBits<Dimension>(points, runBackward(flow, positions)));
}

TYPED_TEST(Invariance, RepeatedMovedAndOneOff)
{
  constexpr int Dimension = TypeParam::value;
  const TestDensity<Dimension> density = densityWithVoids<Dimension>();
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, ParticleCount);
  RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> first = runForward(flow, seeds);
  EXPECT_TRUE(sameBits<Dimension>(first, runForward(flow, seeds)));
  const RectifiedFlow<Dimension> moved = std::move(flow);
  EXPECT_TRUE(sameBits<Dimension>(first, runForward(moved, seeds)));
  EXPECT_TRUE(sameBits<Dimension>(first, transportPoints<Dimension>(density.Source(), seeds)));
}

// Tables in the memory of other ones, of the same and of another size, even where that is gone.
TYPED_TEST(Invariance, MemoryOfAnotherFlow)
{
  constexpr int Dimension = TypeParam::value;
  const TestDensity<Dimension> density = densityWithVoids<Dimension>();
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, ParticleCount);
  const Points<Dimension> expected = runForward(makeFlow(density), seeds);
  GridSize<Dimension> otherSize = density.Size;
  otherSize[0] += 3;
  const SerialExecutor serial;
  const Context cancelled(serial, {}, []() { return true; });
  for (const GridSize<Dimension>& size : { density.Size, otherSize })
  {
    const TestDensity<Dimension> other = randomCells<Dimension>(size);
    const RectifiedFlow<Dimension> flow(density.Source(), makeFlow(other));
    EXPECT_TRUE(sameBits<Dimension>(expected, runForward(flow, seeds)));
    RectifiedFlow<Dimension> previous = makeFlow(other);
    EXPECT_THROW(
      RectifiedFlow<Dimension>(density.Source(), std::move(previous), cancelled), Cancelled);
    const RectifiedFlow<Dimension> after(density.Source(), std::move(previous));
    EXPECT_TRUE(sameBits<Dimension>(expected, runForward(after, seeds)));
    const RectifiedFlow<Dimension> afterMoved(density.Source(), std::move(previous));
    EXPECT_TRUE(sameBits<Dimension>(expected, runForward(afterMoved, seeds)));
  }
}

TYPED_TEST(Invariance, ConcurrentCalls)
{
  constexpr int Dimension = TypeParam::value;
  const TestDensity<Dimension> density = densityWithVoids<Dimension>();
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, ParticleCount);
  for (const FlowMaps maps : OffAndOn)
  {
    // Maps are made by the runs that need them first.
    const RectifiedFlow<Dimension> other = makeFlow(density);
    const Points<Dimension> expected = runForward(other, seeds, with(maps));
    const Points<Dimension> expectedBack = runBackward(other, seeds, with(maps));
    Points<Dimension> forward[2];
    std::thread thread(
      [&]() { forward[0] = runForward(flow, seeds, with(maps), SerialExecutor()); });
    forward[1] = runForward(flow, seeds, with(maps), SerialExecutor());
    const Points<Dimension> back = runBackward(flow, seeds, with(maps), SerialExecutor());
    thread.join();
    EXPECT_TRUE(sameBits<Dimension>(forward[0], expected)) << nameOf(maps);
    EXPECT_TRUE(sameBits<Dimension>(forward[1], expected)) << nameOf(maps);
    EXPECT_TRUE(sameBits<Dimension>(back, expectedBack)) << nameOf(maps);
  }
}

// Integers, floats and doubles of equal values give equal tables.
TYPED_TEST(Invariance, ValueType)
{
  constexpr int Dimension = TypeParam::value;
  TestDensity<Dimension> density = randomCells<Dimension>(densityWithVoids<Dimension>().Size);
  std::vector<unsigned char> bytes;
  std::vector<float> floats;
  for (double& value : density.Values)
  {
    value = std::floor(256.0 * value);
    bytes.push_back(static_cast<unsigned char>(value));
    floats.push_back(static_cast<float>(value));
  }
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, ParticleCount);
  const Points<Dimension> expected = runForward(makeFlow(density), seeds);
  const RectifiedFlow<Dimension> fromBytes(
    DensityArray<Dimension, unsigned char>(bytes.data(), density.Size));
  const RectifiedFlow<Dimension> fromFloats(
    DensityArray<Dimension, float>(floats.data(), density.Size));
  EXPECT_TRUE(sameBits<Dimension>(runForward(fromBytes, seeds), expected));
  EXPECT_TRUE(sameBits<Dimension>(runForward(fromFloats, seeds), expected));
}

} // namespace
} // namespace RectifiedTransport
