// SPDX-License-Identifier: BSD-3-Clause
// Flows with tiles, against those with whole tables. The limits make the tables of small densities
// as coarse, and their tiles as many, as those of large ones.
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Flow/Tiles/TilePlan.h"

#include "../../MemoryLimit.h"
#include "RecordingContext.h"
#include "TestDimensions.h"
#include "TestFlow.h"
#include "TestRefusal.h"
#include "TestTiles.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
TileLimits smallTiles()
{
  return tileLimits<Dimension>(35000, 500000, 40);
}

// Of no multiples of strides or tiles, with sides in 4 : 3 or so.
template <int Dimension>
GridSize<Dimension> oddSize()
{
  return sizeFor<Dimension>({ 100 }, { 231, 187 }, { 97, 91, 83 });
}

template <class T>
using Tiles = DimensionTest<T>;
TYPED_TEST_SUITE(Tiles, PlaneAndSpace);

TYPED_TEST(Tiles, CoverTheDomain)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = oddSize<D>();
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const TilePlan<D> plan(size, 32, direction, false, smallTiles<D>());
    ASSERT_TRUE(plan.IsPossible());
    EXPECT_GE(plan.Tiles.Count(), 1 << D);
    GridSize<D> most{};
    GridSize<D> end{};
    for (std::int64_t tile = 0; tile < plan.Tiles.Count(); ++tile)
    {
      GridSize<D> low;
      GridSize<D> high;
      plan.Tiles.FindCells(tile, low, high);
      for (int axis = 0; axis < D; ++axis)
      {
        EXPECT_GE(low[axis], 0);
        EXPECT_LE(high[axis], size[axis]);
        most[axis] = std::max(most[axis], high[axis] - low[axis]);
        end[axis] = std::max(end[axis], high[axis]);
      }
    }
    EXPECT_EQ(most, plan.Tiles.MostCells());
    EXPECT_EQ(end, size);
    const double time = direction == FlowDirection::Forward ? 1.0 - plan.TimeLeft : 1.0;
    for (const Point<D>& point : randomPoints<D>(size, 1000))
    {
      const std::int64_t tile = plan.TileOf(point.data());
      ASSERT_GE(tile, 0);
      ASSERT_LT(tile, plan.Tiles.Count());
      GridSize<D> low;
      GridSize<D> high;
      plan.Tiles.FindCells(tile, low, high);
      for (int axis = 0; axis < D; ++axis)
      {
        const double length = static_cast<double>(size[axis]);
        const double centre =
          std::clamp(0.5 * length + (point[axis] - 0.5 * length) / time, 0.0, length);
        const double reach =
          0.5 * length * plan.TimeLeft / (1.0 - plan.TimeLeft) * (time < 1.0 ? 1.0 : 2.0);
        EXPECT_LE(static_cast<double>(low[axis]), std::max(0.0, centre - reach));
        EXPECT_GE(static_cast<double>(high[axis]), std::min(length, centre + reach));
      }
    }
  }
}

// Both deviate from the exact map by the same.
template <int Dimension>
void expectSameError(
  const Points<Dimension>& exact, const Points<Dimension>& whole, const Points<Dimension>& tiled)
{
  const PositionErrors expected = comparePositions<Dimension>(whole, exact);
  const PositionErrors found = comparePositions<Dimension>(tiled, exact);
  EXPECT_GT(expected.Mean, 0.0);
  EXPECT_LT(found.Mean, 1.35 * expected.Mean + 1e-3);
  EXPECT_LT(found.Largest, 1.7 * expected.Largest + 0.02);
}

// Without limits on nodes the graded tables hold all of them.
TYPED_TEST(Tiles, AreAsExactAsWholeTables)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = twoGaussians<D>(oddSize<D>());
  const RectifiedFlow<D> whole = makeFlow(density);
  TileLimits allNodes;
  allNodes.Width = 40;
  const Points<D> seeds = randomPoints<D>(density.Size, 1500);
  const FlowOptions exact = with(FlowMaps::Off, steps(192));
  const Points<D> forward = runForward(whole, seeds, exact);
  const Points<D> backward = runBackward(whole, forward, exact);
  for (const TileLimits& limits : { smallTiles<D>(), allNodes })
  {
    const TiledRun<D> run(density, limits);
    for (const FlowMaps maps : OffAndOn)
    {
      SCOPED_TRACE(nameOf(maps) + ", nodes " + std::to_string(limits.GradedNodes));
      const FlowOptions options = with(maps, steps(32));
      expectSameError<D>(
        forward, runForward(whole, seeds, options), runForward(run.Flow, seeds, options));
      expectSameError<D>(
        backward, runBackward(whole, forward, options), runBackward(run.Flow, forward, options));
    }
  }
}

TYPED_TEST(Tiles, LatticesAndOrdersAreTheSamePoints)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = twoGaussians<D>(oddSize<D>());
  const TiledRun<D> run(density, smallTiles<D>());
  const RectifiedFlow<D>& flow = run.Flow;
  const GridSize<D> lattice = evenSize<D>(D == 3 ? 17 : 63);
  Points<D> seeds = latticePoints<D>(density.Size, lattice);
  Points<D> positions(seeds.size());
  for (const FlowMaps maps : OffAndOn)
  {
    SCOPED_TRACE(nameOf(maps));
    const FlowOptions options = with(maps, steps(24));
    const Points<D> forward = runForward(flow, seeds, options);
    flow.Forward(FlowSeeds<D>::Lattice(lattice), positions, options);
    EXPECT_TRUE(sameBits<D>(forward, positions));
    const Points<D> backward = runBackward(flow, seeds, options);
    flow.Backward(FlowSeeds<D>::Lattice(lattice), positions, options);
    EXPECT_TRUE(sameBits<D>(backward, positions));

    Points<D> reversed(seeds.rbegin(), seeds.rend());
    flow.Forward(reversed, reversed, options); // in place
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_TRUE(sameBits<D>(forward, reversed));
    reversed.assign(seeds.rbegin(), seeds.rend());
    flow.Backward(reversed, reversed, options);
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_TRUE(sameBits<D>(backward, reversed));
  }
}

TYPED_TEST(Tiles, SameBitsOnAnyThreads)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = discWithHole<D>(oddSize<D>());
  const Points<D> seeds = randomPoints<D>(density.Size, 5000);
  const SerialExecutor serial;
  const ThreadsExecutor threads(5);
  for (const FlowMaps maps : OffAndOn)
  {
    const FlowOptions options = with(maps, steps(20));
    Points<D> forward[2];
    Points<D> backward[2];
    int run = 0;
    for (const Executor* executor :
      { static_cast<const Executor*>(&serial), static_cast<const Executor*>(&threads) })
    {
      const Context context(*executor);
      const TiledRun<D> tiled(density, smallTiles<D>(), context);
      const RectifiedFlow<D>& flow = tiled.Flow;
      forward[run] = runForward(flow, seeds, options, context);
      backward[run] = runBackward(flow, seeds, options, context);
      ++run;
    }
    EXPECT_TRUE(sameBits<D>(forward[0], forward[1])) << nameOf(maps);
    EXPECT_TRUE(sameBits<D>(backward[0], backward[1])) << nameOf(maps);
  }
}

// Boxes become empty, also before the hand-over: particles are redone, and end in mass.
TYPED_TEST(Tiles, RedoWhatMeetsEmptyBoxes)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = oddSize<D>();
  const std::vector<TestDensity<D>> densities = { discWithHole<D>(size), checker<D>(size, 9),
    randomCells<D>(size), dirac<D>(size, cellOf<D>(evenPoint<D>(60.5), size)) };
  const GridSize<D> lattice = evenSize<D>(D == 3 ? 16 : 60);
  std::int64_t redone = 0;
  for (std::size_t i = 0; i < densities.size(); ++i)
  {
    const RectifiedFlow<D> whole = makeFlow(densities[i]);
    const TiledRun<D> run(densities[i], smallTiles<D>());
    const RectifiedFlow<D>& tiled = run.Flow;
    for (const FlowMaps maps : OffAndOn)
    {
      SCOPED_TRACE(std::to_string(i) + ", " + nameOf(maps));
      const FlowOptions options = with(maps, steps(24));
      Points<D> expected(static_cast<std::size_t>(cellCount<D>(lattice)));
      Points<D> found(expected.size());
      const FlowReport wholeReport =
        whole.Forward(FlowSeeds<D>::Lattice(lattice), expected, options);
      const FlowReport report = tiled.Forward(FlowSeeds<D>::Lattice(lattice), found, options);
      redone += report.Redone;
      EXPECT_LE(report.MovedToMass, 2 * wholeReport.MovedToMass + 20);
      std::size_t far = 0;
      for (std::size_t p = 0; p < found.size(); ++p)
      {
        ASSERT_TRUE(isInside<D>(found[p], size)) << p;
        EXPECT_TRUE(tiled.HasMass(found[p])) << p;
        double squared = 0.0;
        for (int axis = 0; axis < D; ++axis)
        {
          squared += (found[p][axis] - expected[p][axis]) * (found[p][axis] - expected[p][axis]);
        }
        far += squared > 0.25 ? 1 : 0;
      }
      EXPECT_LE(far, found.size() / 20); // at edges, paths part
    }
  }
  EXPECT_GT(redone, 0);
}

// Cells apart, between which boxes are empty before particles reach their tiles.
TEST(TilesOfIslands, RedoWhatMeetsEmptyBoxesBefore)
{
  TestDensity<2> islands = uniformDensity<2>(oddSize<2>());
  for (std::size_t i = 0; i < islands.Values.size(); ++i)
  {
    islands.Values[i] = i % 5003 == 0 ? 1.0 : 0.0;
  }
  const FlowOptions options = with(FlowMaps::On, steps(24));
  const GridSize<2> lattice = evenSize<2>(60);
  Points<2> found(static_cast<std::size_t>(cellCount<2>(lattice)));
  const FlowReport whole =
    makeFlow(islands).Forward(FlowSeeds<2>::Lattice(lattice), found, options);
  const TiledRun<2> run(islands, smallTiles<2>());
  const FlowReport tiled = run.Flow.Forward(FlowSeeds<2>::Lattice(lattice), found, options);
  EXPECT_GT(tiled.Redone, whole.Redone * 5 / 6);
}

// Powers of two, so that extreme values are scaled without rounding.
TYPED_TEST(Tiles, TakeValuesOfAnySize)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = twoGaussians<D>(oddSize<D>());
  TestDensity<D> huge = density;
  for (double& value : huge.Values)
  {
    value = std::ldexp(value, 900);
  }
  const Points<D> seeds = randomPoints<D>(density.Size, 500);
  const TiledRun<D> run(density, smallTiles<D>());
  const RectifiedFlow<D>& flow = run.Flow;
  const TiledRun<D> hugeRun(huge, smallTiles<D>());
  const RectifiedFlow<D>& hugeFlow = hugeRun.Flow;
  EXPECT_EQ(std::ldexp(flow.Total(), 900), hugeFlow.Total());
  EXPECT_LT(largestDistance<D>(runForward(flow, seeds), runForward(hugeFlow, seeds)), 1e-6);
}

TYPED_TEST(Tiles, SayWhatWholeTablesSay)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = randomCells<D>(oddSize<D>());
  const RectifiedFlow<D> whole = makeFlow(density);
  const TiledRun<D> run(density, smallTiles<D>());
  const RectifiedFlow<D>& tiled = run.Flow;
  EXPECT_NEAR(tiled.Total(), whole.Total(), 1e-12 * whole.Total());
  for (int axis = 0; axis < D; ++axis)
  {
    EXPECT_NEAR(tiled.Centroid()[axis], whole.Centroid()[axis], 1e-9);
  }
  const Points<D> corners = randomPoints<D>(density.Size, 40);
  for (std::size_t i = 0; i + 1 < corners.size(); i += 2)
  {
    Point<D> low = corners[i];
    Point<D> high = corners[i + 1];
    for (int axis = 0; axis < D; ++axis)
    {
      std::tie(low[axis], high[axis]) = std::minmax({ low[axis], high[axis] + 20.0 });
    }
    EXPECT_NEAR(tiled.Share(low, high), whole.Share(low, high), 1e-12);
    EXPECT_EQ(tiled.HasMass(low), whole.HasMass(low));
  }
  Point<D> middle = corners[0];
  for (int axis = 0; axis < D; ++axis)
  {
    middle[axis] = 30.25;
  }
  Point<D> nearBy = middle;
  nearBy[0] += 0.5; // within one cell
  EXPECT_EQ(tiled.Share(middle, middle), 0.0);
}

TYPED_TEST(Tiles, Refuse)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = twoGaussians<D>(oddSize<D>());
  const TiledRun<D> run(density, smallTiles<D>());
  const RectifiedFlow<D>& flow = run.Flow;
  const Points<D> seeds = randomPoints<D>(density.Size, 10);
  for (const Integrator method :
    { Integrator::RungeKutta4, Integrator::Euler, Integrator::Adaptive })
  {
    EXPECT_NE(refusal([&]() { runForward(flow, seeds, steps(32, method)); }).find("multistep"),
      std::string::npos);
  }
  FlowOptions nearest;
  nearest.Lookup = TableLookup::Nearest;
  EXPECT_NE(
    refusal([&]() { runBackward(flow, seeds, nearest); }).find("interpolated"), std::string::npos);
  EXPECT_EQ(refusal([&]() { runForward(flow, seeds, steps(4)); }),
    "NumberOfSteps is 4, which is too few for tiles of this density: more steps or whole tables "
    "are needed");
  Points<D> positions(seeds.size());
  EXPECT_NE(refusal([&]() { flow.ForwardAt(seeds, { 0.5 }, positions); }).find("whole tables"),
    std::string::npos);
  std::vector<std::int64_t> cells(seeds.size());
  EXPECT_NE(refusal([&]() { flow.ForwardToCells(seeds, cells.data()); }).find("whole tables"),
    std::string::npos);
  EXPECT_NE(
    refusal([&]() { flow.MeasureOfShare(seeds[0], evenPoint<D>(1.0), 0.1); }).find("whole tables"),
    std::string::npos);
  FlowOptions wrong;
  wrong.NumberOfSteps = -1;
  EXPECT_NE(refusal([&]() { runForward(flow, seeds, wrong); }).find("from 0"), std::string::npos);
  Points<D> broken = seeds;
  broken[3][1] = std::nan("");
  EXPECT_EQ(refusal([&]() { runForward(flow, broken); }), "point 3 is not finite");
}

TYPED_TEST(Tiles, NameInvalidValues)
{
  constexpr int D = TypeParam::value;
  TestDensity<D> density = twoGaussians<D>(oddSize<D>());
  density.Values[5000] = -1.0;
  density.Values[7000] = -1.0;
  density.Values[9000] = std::nan("");
  try
  {
    const TiledRun<D> run(density, smallTiles<D>());
    ADD_FAILURE();
  }
  catch (const InvalidDensity& invalid)
  {
    EXPECT_EQ(invalid.Summary().Negative, 2);
    EXPECT_EQ(invalid.Summary().FirstNegative, 5000);
    EXPECT_EQ(invalid.Summary().NotFinite, 1);
    EXPECT_EQ(invalid.Summary().FirstNotFinite, 9000);
  }
  EXPECT_THROW(TiledRun<D>(uniformDensity<D>(oddSize<D>(), 0.0), smallTiles<D>()), InvalidDensity);
}

TYPED_TEST(Tiles, ReportAndStop)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = discWithHole<D>(oddSize<D>());
  const GridSize<D> lattice = evenSize<D>(D == 3 ? 40 : 200);
  Points<D> positions(static_cast<std::size_t>(cellCount<D>(lattice)));
  const SerialExecutor serial;
  for (const FlowMaps maps : OffAndOn)
  {
    for (const bool isBackward : { false, true })
    {
      RecordingContext recording(serial);
      const auto run = [&]() {
        const TiledRun<D> tiled(density, smallTiles<D>(), recording.Context());
        const RectifiedFlow<D>& flow = tiled.Flow;
        recording.Reported.clear();
        const FlowOptions options = with(maps, steps(24));
        isBackward
          ? flow.Backward(FlowSeeds<D>::Lattice(lattice), positions, options, recording.Context())
          : flow.Forward(FlowSeeds<D>::Lattice(lattice), positions, options, recording.Context());
      };
      run();
      recording.ExpectReported(0.0, 1.0);
      const int all = recording.Queries;
      for (const double part : { 0.01, 0.3, 0.6, 0.95 })
      {
        recording.Queries = 0;
        recording.MaximumQueries = static_cast<int>(part * all);
        EXPECT_THROW(run(), Cancelled) << part;
      }
    }
  }
}

#ifdef HAS_MEMORY_LIMIT
// The formula is enough, and not much more than that. Particles that no map serves take the most.
TYPED_TEST(Tiles, TakeTheMemoryForetold)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 100 }, { 2500, 2000 }, { 128, 120, 110 });
  const TestDensity<D> density = discWithHole<D>(size);
  const TileLimits limits = tileLimits<D>(1500000, 800000, D == 3 ? 60 : 300);
  const SerialExecutor serial;
  const Context context(serial);
  Points<D> positions = randomPoints<D>(size, 400000);
  const GridSize<D> lattice = sizeFor<D>({ 1 }, { 800, 500 }, { 80, 100, 50 });
  for (const FlowMaps maps : OffAndOn)
  {
    for (const bool isLattice : { true, false })
    {
      for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
      {
        const bool isForward = direction == FlowDirection::Forward;
        SCOPED_TRACE(nameOf(maps) + (isLattice ? ", lattice" : ", points") +
          (isForward ? ", forward" : ", backward"));
        const FlowOptions options = with(maps, steps(16));
        const auto run = [&](double bytes) {
          const MemoryLimit limit(static_cast<std::int64_t>(bytes));
          const TiledRun<D> tiled(density, limits, context);
          const RectifiedFlow<D>& flow = tiled.Flow;
          isLattice&& isForward
            ? flow.Forward(FlowSeeds<D>::Lattice(lattice), positions, options, context)
            : isLattice ? flow.Backward(FlowSeeds<D>::Lattice(lattice), positions, options, context)
            : isForward ? flow.Forward(positions, positions, options, context)
                        : flow.Backward(positions, positions, options, context);
        };
        const double bytes = RectifiedFlow<D>::TiledMemoryFor(
          size, options, direction, static_cast<double>(positions.size()), isLattice, limits);
        constexpr double small = 24e6; // the program's own, and what lies between blocks
        EXPECT_NO_THROW(run(bytes + small)) << bytes;
        EXPECT_THROW(run(0.5 * bytes - small), std::bad_alloc) << bytes;
      }
    }
  }
}
#endif

TEST(TilesOfALine, Refuse)
{
  const TestDensity<1> density = twoGaussians<1>({ 1000 });
  EXPECT_NE(
    refusal([&]() { RectifiedFlow<1>(density.Source(), FlowTables::Tiled); }).find("one axis"),
    std::string::npos);
}

// Thin, and narrower than a box.
TEST(TilesOfASlab, AreAsExactAsWholeTables)
{
  for (const GridSize<3>& size : { GridSize<3>{ 300, 5, 40 }, GridSize<3>{ 2, 160, 150 } })
  {
    const TestDensity<3> density = twoGaussians<3>(size);
    TileLimits limits;
    limits.GradedNodes = 40000;
    limits.Width = 40;
    const TiledRun<3> run(density, limits);
    const RectifiedFlow<3>& tiled = run.Flow;
    const Points<3> seeds = randomPoints<3>(size, 1000);
    const RectifiedFlow<3> whole = makeFlow(density);
    const Points<3> exact = runForward(whole, seeds, steps(192));
    const FlowOptions usual = steps(32);
    expectSameError<3>(exact, runForward(whole, seeds, usual), runForward(tiled, seeds, usual));
    const Points<3> back = runBackward(whole, exact, steps(192));
    expectSameError<3>(back, runBackward(whole, exact, usual), runBackward(tiled, exact, usual));
  }
}

} // namespace
} // namespace RectifiedTransport
