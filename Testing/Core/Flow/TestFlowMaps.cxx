// SPDX-License-Identifier: BSD-3-Clause
// Flow maps: particles that start from them are where they should be. TestInvariance and
// TestConvergence run with and without them, too.
#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/FlowMap.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"

#include "FlowMapShapes.h"
#include "RecordingContext.h"
#include "TestDimensions.h"
#include "TestFlow.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
TestDensity<Dimension> densityWithMaps()
{
  return twoGaussians<Dimension>(sizeFor<Dimension>({ 100 }, { 224, 208 }, { 96, 80, 90 }));
}

// Numbers of steps with which this density has maps.
template <int Dimension>
std::vector<int> stepsWithMaps()
{
  return Dimension == 3 ? std::vector<int>{ 16, 24 } : std::vector<int>{ 16, 32, 64 };
}

// In space maps of 32 steps take long where a sanitizer slows them down.
template <int Dimension>
FlowOptions usual(FlowMaps maps)
{
  return with(maps, steps(Dimension == 3 ? 16 : 32));
}

template <class T>
using FlowMapRun = DimensionTest<T>;
TYPED_TEST_SUITE(FlowMapRun, PlaneAndSpace);

// What Auto means depends on the number of particles, not on what ran before.
TYPED_TEST(FlowMapRun, Auto)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = densityWithMaps<D>();
  const FlowOptions options = steps(16);
  const FlowMapShape<D> shape = forwardShape<D>(density.Size, options.NumberOfSteps);
  ASSERT_FALSE(shape.Levels.empty());
  const std::size_t enough = particlesThatPay(shape);
  const RectifiedFlow<D> flow = makeFlow(density);
  const Points<D> many = randomPoints<D>(density.Size, enough);
  const Points<D> few(many.begin(), many.begin() + static_cast<std::ptrdiff_t>(enough / 4));
  const auto run = [&](const Points<D>& seeds, FlowMaps maps) {
    return runForward(flow, seeds, with(maps, options));
  };
  const Points<D> withMaps = run(many, FlowMaps::On);
  EXPECT_TRUE(sameBits<D>(run(many, FlowMaps::Auto), withMaps));
  EXPECT_TRUE(sameBits<D>(run(few, FlowMaps::Auto), run(few, FlowMaps::Off)));
  EXPECT_FALSE(sameBits<D>(withMaps, run(many, FlowMaps::Off)));
}

// Kept maps give the bits of new ones, also after those of another number of steps.
TYPED_TEST(FlowMapRun, Kept)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = densityWithMaps<D>();
  const RectifiedFlow<D> flow = makeFlow(density);
  const Points<D> seeds = randomPoints<D>(density.Size, 3000);
  const std::int64_t tables = flow.MemorySize();
  const Points<D> first = runForward(flow, seeds, usual<D>(FlowMaps::On));
  const double map = static_cast<double>(flow.MemorySize() - tables);
  EXPECT_EQ(map, forwardShape<D>(density.Size, usual<D>(FlowMaps::On).NumberOfSteps).MemorySize());
  Points<D> again(seeds.size());
  const FlowReport kept = flow.Forward(seeds, again, usual<D>(FlowMaps::On));
  EXPECT_TRUE(sameBits<D>(first, again));
  const FlowReport made = flow.Forward(seeds, again, with(FlowMaps::On, steps(24)));
  EXPECT_GT(made.Evaluations, kept.Evaluations);
  EXPECT_TRUE(
    sameBits<D>(again, runForward(makeFlow(density), seeds, with(FlowMaps::On, steps(24)))));
  EXPECT_TRUE(sameBits<D>(first, runForward(flow, seeds, usual<D>(FlowMaps::On))));
  const FlowReport direct = flow.Forward(seeds, again, usual<D>(FlowMaps::Off));
  EXPECT_LT(kept.Evaluations, direct.Evaluations * 3 / 5);
}

// Particles of a lattice share sums of records with their neighbours; the bits are those of points.
TYPED_TEST(FlowMapRun, LatticeIsItsPoints)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = densityWithMaps<D>();
  const RectifiedFlow<D> flow = makeFlow(density);
  for (const GridSize<D>& lattice :
    { sizeFor<D>({}, { 224, 208 }, { 48, 40, 45 }), evenSize<D>(29) })
  {
    const Points<D> centres = latticePoints<D>(density.Size, lattice);
    Points<D> positions(centres.size());
    flow.Forward(FlowSeeds<D>::Lattice(lattice), positions, usual<D>(FlowMaps::On));
    EXPECT_TRUE(sameBits<D>(positions, runForward(flow, centres, usual<D>(FlowMaps::On))));
    flow.Backward(FlowSeeds<D>::Lattice(lattice), positions, usual<D>(FlowMaps::On));
    EXPECT_TRUE(sameBits<D>(positions, runBackward(flow, centres, usual<D>(FlowMaps::On))));
  }
}

// The output may be the array of the seeds.
TYPED_TEST(FlowMapRun, InPlace)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = densityWithMaps<D>();
  const RectifiedFlow<D> flow = makeFlow(density);
  const Points<D> seeds = randomPoints<D>(density.Size, 2011);
  Points<D> points = seeds;
  flow.Forward(points, points, usual<D>(FlowMaps::On));
  const Points<D> positions = runForward(flow, seeds, usual<D>(FlowMaps::On));
  EXPECT_TRUE(sameBits<D>(points, positions));
  flow.Backward(points, points, usual<D>(FlowMaps::On));
  EXPECT_TRUE(sameBits<D>(points, runBackward(flow, positions, usual<D>(FlowMaps::On))));
}

// All times after the last hand-over come from the maps, else none does.
TYPED_TEST(FlowMapRun, Times)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = densityWithMaps<D>();
  const RectifiedFlow<D> flow = makeFlow(density);
  const Points<D> seeds = randomPoints<D>(density.Size, 500);
  const double handOver = 1.0 -
    forwardShape<D>(density.Size, usual<D>(FlowMaps::On).NumberOfSteps).Levels.back().TimeLeft;
  Points<D> late(2 * seeds.size());
  flow.ForwardAt(seeds, { handOver, 1.0 }, late, usual<D>(FlowMaps::On));
  const Points<D> ends = runForward(flow, seeds, usual<D>(FlowMaps::On));
  Points<D> direct(2 * seeds.size());
  flow.ForwardAt(seeds, { handOver, 1.0 }, direct, usual<D>(FlowMaps::Off));
  Points<D> truth(2 * seeds.size());
  flow.ForwardAt(seeds, { handOver, 1.0 }, truth, with(FlowMaps::Off, steps(600)));
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    EXPECT_EQ(late[2 * i + 1], ends[i]);
  }
  const auto errorAt = [&](const Points<D>& points, std::size_t time) {
    Points<D> places;
    Points<D> expected;
    for (std::size_t i = time; i < points.size(); i += 2)
    {
      places.push_back(points[i]);
      expected.push_back(truth[i]);
    }
    return comparePositions<D>(places, expected).Mean;
  };
  EXPECT_LT(errorAt(late, 0), errorAt(direct, 0));
  EXPECT_LT(errorAt(late, 1), errorAt(direct, 1));

  Points<D> early(2 * seeds.size());
  flow.ForwardAt(seeds, { 0.9 * handOver, 1.0 }, early, usual<D>(FlowMaps::On));
  flow.ForwardAt(seeds, { 0.9 * handOver, 1.0 }, direct, usual<D>(FlowMaps::Off));
  EXPECT_TRUE(sameBits<D>(early, direct));
}

// The errors of maps, forward and back, are smaller than those without; backwards the largest are
// not.
TYPED_TEST(FlowMapRun, Errors)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = densityWithMaps<D>();
  const RectifiedFlow<D> flow = makeFlow(density);
  const Points<D> seeds = randomPoints<D>(density.Size, D == 3 ? 1000 : 3000);
  const Points<D> truth = runForward(flow, seeds, with(FlowMaps::Off, steps(300)));
  const Points<D> past = runBackward(flow, truth, with(FlowMaps::Off, steps(300)));
  for (const int count : stepsWithMaps<D>())
  {
    const auto errors = [&](FlowMaps maps, bool back) {
      const FlowOptions options = with(maps, steps(count));
      return back ? comparePositions<D>(runBackward(flow, truth, options), past)
                  : comparePositions<D>(runForward(flow, seeds, options), truth);
    };
    for (const bool back : { false, true })
    {
      const FlowDirection direction = back ? FlowDirection::Backward : FlowDirection::Forward;
      ASSERT_FALSE(FlowMapShape<D>(density.Size, count, direction).Levels.empty()) << count;
      const PositionErrors direct = errors(FlowMaps::Off, back);
      const PositionErrors mapped = errors(FlowMaps::On, back);
      const std::string what = std::to_string(count) + (back ? ", backward" : ", forward");
      EXPECT_LT(mapped.Mean, direct.Mean) << what;
      EXPECT_LT(mapped.Percentile95, direct.Percentile95) << what;
      EXPECT_LE(mapped.Percentile999, (back ? 1.6 : 1.0) * direct.Percentile999) << what;
    }
  }
}

template <int Dimension>
void expectNoStrays(const TestDensity<Dimension>& density, int count, const std::string& what)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, 4000);
  const FlowOptions options = with(FlowMaps::On, steps(count));
  const Strays<Dimension> strays(runForward(flow, seeds, options), density);
  EXPECT_EQ(strays.Outside, 0) << what << ", " << count;
  EXPECT_EQ(strays.InEmptyCells, 0) << what << ", " << count;
  for (const Point<Dimension>& point : runBackward(flow, seeds, options))
  {
    ASSERT_TRUE(isInside<Dimension>(point, density.Size)) << what << ", " << count;
  }
}

// Voids, isolated cells and a corner.
TYPED_TEST(FlowMapRun, NoStrays)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 1 }, { 150, 131 }, { 96, 80, 90 });
  TestDensity<D> few = randomCells<D>(size);
  for (double& value : few.Values)
  {
    value = value < 0.97 ? 0.0 : value;
  }
  TestDensity<D> corner = randomCells<D>(size);
  std::fill(corner.Values.begin() + 5, corner.Values.end(), 0.0);
  for (const int count : { 12, D == 3 ? 16 : 32 })
  {
    ASSERT_FALSE(forwardShape<D>(size, count).Levels.empty()) << count;
    expectNoStrays<D>(discWithHole<D>(size), count, "disc");
    expectNoStrays<D>(few, count, "few cells");
    expectNoStrays<D>(corner, count, "corner");
  }
}

// Sizes that are long, flat or small.
TYPED_TEST(FlowMapRun, Sizes)
{
  constexpr int D = TypeParam::value;
  for (const GridSize<D>& size : { sizeFor<D>({}, { 2000, 17 }, { 600, 40, 30 }),
         sizeFor<D>({}, { 16, 3000 }, { 70, 16, 700 }) })
  {
    EXPECT_FALSE(forwardShape<D>(size, 20).Levels.empty());
    expectNoStrays<D>(twoGaussians<D>(size), 20, "size " + std::to_string(size[0]));
  }
  for (const int count : { 1, 8, 20, 100 })
  {
    for (const GridSize<D>& size : { sizeFor<D>({ 1 }, { 16, 16 }, { 16, 16, 16 }),
           sizeFor<D>({ 1 }, { 901, 17 }, { 301, 16, 5 }),
           sizeFor<D>({ 1 }, { 1, 2000 }, { 1, 70, 300 }), evenSize<D>(1) })
    {
      expectNoStrays<D>(twoGaussians<D>(size), count, "size " + std::to_string(size[0]));
    }
  }
}

// Particles of a uniform density return to their seeds.
TYPED_TEST(FlowMapRun, Uniform)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = uniformDensity<D>(densityWithMaps<D>().Size);
  const RectifiedFlow<D> flow = makeFlow(density);
  const Points<D> seeds = randomPoints<D>(density.Size, 1000);
  for (const int count : stepsWithMaps<D>())
  {
    const auto error = [&](FlowMaps maps) {
      return comparePositions<D>(runForward(flow, seeds, with(maps, steps(count))), seeds).Mean;
    };
    EXPECT_LT(error(FlowMaps::On), 0.75 * error(FlowMaps::Off)) << count;
  }
}

// How many levels of a map for this shape are kept, and the bad cells in them.
struct Kept
{
  int Levels;
  std::int64_t Bad;
};

template <int Dimension>
Kept keptLevels(const FlowMapShape<Dimension>& shape, const TestDensity<Dimension>& density,
  const Context& context = Context())
{
  Progress progress{ Context() };
  const SummedAreaTables<Dimension> tables(density.Source(), progress);
  const AdvectionJob<Dimension> job(
    tables.View(), AdvectionKind::Forward, steps(shape.NumberOfSteps));
  const FlowMap<Dimension> map(shape, job.Job, context);
  std::int64_t bad = 0;
  for (int i = 0; i < map.View().LevelCount; ++i)
  {
    const FlowMapLevel<Dimension>& level = map.View().Levels[i];
    std::int64_t cells = 1;
    for (const LatticeAxis& axis : level.Axes)
    {
      cells *= axis.Cells;
    }
    bad += std::count(level.Bad, level.Bad + cells, 1);
  }
  return { map.View().LevelCount, bad };
}

// Nodes that met an empty box are not interpolated, however straight the lattice is; each rank
// knows of those of the others.
TYPED_TEST(FlowMapRun, TroubledCells)
{
  constexpr int D = TypeParam::value;
  FlowMapShape<D> shape = forwardShape<D>(densityWithMaps<D>().Size);
  ASSERT_FALSE(shape.Levels.empty());
  shape.Deviation.fill(1e15);
  TestDensity<D> islands = densityWithMaps<D>();
  const std::size_t apart = D == 3 ? 20011 : 2003; // cells
  for (std::size_t i = 0; i < islands.Values.size(); ++i)
  {
    islands.Values[i] = i % apart == apart / 2 ? 1.0 : 0.0;
  }
  const std::int64_t bad = keptLevels<D>(shape, islands).Bad;
  EXPECT_GT(bad, 0);
  runOnRanks(3, [&](const Ranks& ranks) {
    Context context;
    context.Group = &ranks;
    EXPECT_EQ(keptLevels<D>(shape, islands, context).Bad, bad);
  });
  EXPECT_EQ(keptLevels<D>(shape, densityWithMaps<D>()).Bad, 0);
}

// Cells of which a cubic leaves out more than is allowed are not interpolated; a level of which
// that is most is not kept.
TYPED_TEST(FlowMapRun, BentCells)
{
  constexpr int D = TypeParam::value;
  FlowMapShape<D> shape = forwardShape<D>(densityWithMaps<D>().Size);
  const Kept usual = keptLevels<D>(shape, densityWithMaps<D>());
  EXPECT_EQ(usual.Levels, static_cast<int>(shape.Levels.size()));
  EXPECT_GT(usual.Bad, 0);
  for (double& deviation : shape.Deviation)
  {
    deviation /= 64;
  }
  EXPECT_EQ(keptLevels<D>(shape, densityWithMaps<D>()).Levels, 0);
}

// A run that is cancelled while maps are made leaves none.
TYPED_TEST(FlowMapRun, Cancelled)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = densityWithMaps<D>();
  const RectifiedFlow<D> flow = makeFlow(density);
  const Points<D> seeds = randomPoints<D>(density.Size, 100);
  Points<D> positions(seeds.size());
  const SerialExecutor serial;
  const std::int64_t tables = flow.MemorySize();
  for (int queries = 0, isComplete = 0; isComplete == 0; queries = 2 * queries + 1)
  {
    RecordingContext recording(serial);
    recording.MaximumQueries = queries;
    try
    {
      runForward(flow, seeds, usual<D>(FlowMaps::On), recording.Context());
      isComplete = 1;
    }
    catch (const class Cancelled&)
    {
      EXPECT_TRUE(flow.MemorySize() == tables || recording.Reported.back() > 0.9) << queries;
    }
    EXPECT_EQ(isComplete, recording.Queries <= queries ? 1 : 0);
  }
  EXPECT_TRUE(sameBits<D>(runForward(flow, seeds, usual<D>(FlowMaps::On)),
    runForward(makeFlow(density), seeds, usual<D>(FlowMaps::On))));
}

TYPED_TEST(FlowMapRun, Progress)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = densityWithMaps<D>();
  const RectifiedFlow<D> flow = makeFlow(density);
  const Points<D> seeds = randomPoints<D>(density.Size, 100);
  const SerialExecutor serial;
  RecordingContext recording(serial);
  runForward(flow, seeds, usual<D>(FlowMaps::On), recording.Context());
  EXPECT_LT(recording.Reported.front(), 0.5);
  recording.ExpectReported(0.0, 1.0);
}

// They commute with flips, where lattices are symmetric, up to the rounding of their records.
TYPED_TEST(FlowMapRun, Flip)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = densityWithMaps<D>();
  TestDensity<D> flipped = density;
  std::reverse(flipped.Values.begin(), flipped.Values.end());
  Points<D> seeds = randomPoints<D>(density.Size, 1000);
  const auto flip = [&density](Points<D> points) {
    for (Point<D>& point : points)
    {
      for (int axis = 0; axis < D; ++axis)
      {
        point[axis] = static_cast<double>(density.Size[axis]) - point[axis];
      }
    }
    return points;
  };
  const FlowOptions options = usual<D>(FlowMaps::On);
  ASSERT_FALSE(forwardShape<D>(density.Size, usual<D>(FlowMaps::On).NumberOfSteps).Levels.empty());
  const Points<D> expected = runForward(makeFlow(density), seeds, options);
  const Points<D> mirrored = flip(runForward(makeFlow(flipped), flip(seeds), options));
  EXPECT_LT(comparePositions<D>(expected, mirrored).Percentile95, 1e-3);
}

} // namespace
} // namespace RectifiedTransport
