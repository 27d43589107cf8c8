// SPDX-License-Identifier: BSD-3-Clause
// NumberOfSteps 0: how many steps are chosen, and whether they keep AreaTolerance.
#include "Core/Flow/PivotLattice.h"
#include "Core/Geometry/ImageMeasure.h"

#include "AreaErrors.h"
#include "TestFlow.h"
#include "TestTiles.h"
#include "ThreadRanks.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// Needs many steps.
TestDensity<2> thinCircle()
{
  constexpr std::int64_t side = 128;
  return sampleDensity<2>({ side, side }, [](const Point<2>& p) {
    const double radius = std::hypot(p[0] - 0.5, p[1] - 0.5);
    return std::abs(radius - 1.0 / 3.0) * side < 0.7 ? 1.0 : 1e-6;
  });
}

template <int Dimension>
StepChoice choiceOf(const TestDensity<Dimension>& density, FlowDirection direction,
  const FlowOptions& options = {}, const Context& context = Context())
{
  return RectifiedFlow<Dimension>(density.Source(), context)
    .ChooseSteps(options, direction, context);
}

FlowOptions within(double tolerance, Integrator method = Integrator::Multistep)
{
  FlowOptions options;
  options.AreaTolerance = tolerance;
  options.Integrator = method;
  return options;
}

// One cell of a million in ones.
TestDensity<2> spike()
{
  constexpr std::int64_t side = 256;
  TestDensity<2> density = uniformDensity<2>({ side, side });
  density.Values[static_cast<std::size_t>(side / 2 * side + side / 3)] = 1e6;
  return density;
}

// Mass in a small part of the domain, which no block meets of those that are spread evenly.
TestDensity<2> smallDisc(std::int64_t side, double outside)
{
  return sampleDensity<2>({ side, side }, [&](const Point<2>& p) {
    return std::hypot(p[0] - 0.3, p[1] - 0.6) * static_cast<double>(side) < 7.0 ? 1.0 : outside;
  });
}

// The error, in tolerances, is at most `most`: what is kept is an estimate.
template <int Dimension>
void expectKept(const TestDensity<Dimension>& density, double tolerance, double most = 1.0)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const FlowOptions options = within(tolerance);
  const StepChoice choice = flow.ChooseSteps(options, FlowDirection::Backward);
  EXPECT_LE(choice.AreaError, tolerance);
  const Points<Dimension> corners = cornerLattice<Dimension>(density.Size);
  const auto areas = [&](const FlowOptions& taken) {
    return blockAreas<Dimension>(density, runBackward(flow, corners, taken));
  };
  const std::vector<double> exact = areas(with(FlowMaps::Off, steps(1024))).Area;
  const auto error = [&](const FlowOptions& taken) {
    return quantileOf(areas(taken).Errors(exact), 0.999);
  };
  for (const FlowMaps maps : OffAndOn)
  {
    EXPECT_LT(error(with(maps, options)), most * tolerance)
      << nameOf(maps) << ", " << choice.NumberOfSteps << " steps";
  }
  // Not by far more steps than it takes.
  EXPECT_GT(error(with(FlowMaps::Off, steps(choice.NumberOfSteps / 4))), tolerance)
    << choice.NumberOfSteps << " steps";
}

TEST(AutomaticSteps, KeepTheTolerance)
{
  expectKept<2>(denseBall<2>(96, 100.0), 0.021, 1.1); // it is 1.04
  expectKept<2>(denseBall<2>(96, 100.0), 0.1);
  expectKept<2>(denseBall<2>(128, 10.0), 0.021, 1.1); // it is 1.04
  expectKept<2>(twoGaussians<2>({ 140, 120 }), 0.02);
  expectKept<2>(randomCells<2>({ 100, 130 }), 0.02);
  expectKept<3>(denseBall<3>(24, 100.0), 0.021, 1.1); // it is 1.05
}

TEST(AutomaticSteps, SmallSupport)
{
  EXPECT_GT(choiceOf<2>(smallDisc(300, 0.0), FlowDirection::Backward).AreaError, 0.0);
}

// Within blocks, where their means are alike.
TEST(AutomaticSteps, FineContrast)
{
  const auto lines = [](double between) {
    TestDensity<2> density = uniformDensity<2>({ 128, 128 });
    for (std::size_t i = 0; i < density.Values.size(); ++i)
    {
      density.Values[i] = i % 128 % 3 == 0 ? 1.0 : between;
    }
    return choiceOf<2>(density, FlowDirection::Forward).NumberOfSteps;
  };
  EXPECT_EQ(lines(0.7), 32);
  EXPECT_GT(lines(0.1), 32);
}

// Contrasts make steps, scales without contrast do not.
TEST(AutomaticSteps, Contrast)
{
  for (const TestDensity<2>& plain :
    { uniformDensity<2>({ 200, 150 }), randomCells<2>({ 200, 150 }, 0.3) })
  {
    const StepChoice choice = choiceOf<2>(plain, FlowDirection::Forward);
    EXPECT_EQ(choice.NumberOfSteps, 32);
    EXPECT_TRUE(std::isnan(choice.AreaError));
  }
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    // No limit, unlike with the usual tolerance.
    const auto stepsOf = [&](double contrast, double tolerance) {
      return choiceOf<2>(denseBall<2>(128, contrast), direction, within(tolerance)).NumberOfSteps;
    };
    const int ten = stepsOf(10.0, 0.021);
    const int hundred = stepsOf(100.0, 0.021);
    EXPECT_GT(ten, 32);
    EXPECT_GT(hundred, ten);
    const int rough = stepsOf(100.0, 0.2);
    EXPECT_LT(rough, hundred);
    EXPECT_GE(rough, 32);
  }
}

// Of thin ground, too: the blocks around a dense disc are those with the largest errors.
TEST(AutomaticSteps, EstimateOnThinGround)
{
  const TestDensity<2> density = denseBall<2>(128, 1000.0);
  const RectifiedFlow<2> flow = makeFlow(density);
  const StepChoice choice = flow.ChooseSteps({}, FlowDirection::Backward);
  const Points<2> corners = cornerLattice<2>(density.Size);
  const auto areas = [&](const FlowOptions& taken) {
    return blockAreas<2>(density, runBackward(flow, corners, taken));
  };
  const std::vector<double> exact = areas(with(FlowMaps::Off, steps(1024))).Area;
  const BlockAreas found = areas(choice.Of({}));
  std::vector<double> errors;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    const double least = LeastOfMean * AreaBlock * AreaBlock;
    errors.push_back(std::abs(found.Area[i] - exact[i]) / std::max(found.Mass[i], least));
  }
  std::sort(errors.begin(), errors.end());
  const double error = quantileOf(errors, 0.999);
  EXPECT_GT(choice.AreaError, 0.5 * error);
  EXPECT_LT(choice.AreaError, 2.0 * error);
}

// Particles show no errors of blocks that hold few of them.
TEST(AutomaticSteps, FewParticles)
{
  const TestDensity<2> density = denseBall<2>(256, 100.0);
  const RectifiedFlow<2> flow = makeFlow(density);
  int before = FlowOptions::MaximumNumberOfSteps;
  for (const double particles : { 1e6, 4e4, 300.0 })
  {
    FlowOptions options;
    options.Particles = particles;
    const StepChoice choice = flow.ChooseSteps(options, FlowDirection::Forward);
    EXPECT_LE(choice.NumberOfSteps, before) << particles << " particles";
    before = choice.NumberOfSteps;
    EXPECT_EQ(std::isnan(choice.AreaError), particles == 300.0);
  }
  EXPECT_EQ(before, 32);
}

// Densities that are mirrored or turned.
TEST(AutomaticSteps, AreTheSameForMirrorImages)
{
  const TestDensity<2> density = sampleDensity<2>({ 96, 80 }, [](const Point<2>& p) {
    return std::hypot(p[0] - 0.3, 1.2 * (p[1] - 0.7)) < 0.2 ? 20.0 : 1.0 + p[0] * p[1];
  });
  const GridSize<2>& size = density.Size;
  const TestDensity<2> mirrored = sampleDensity<2>(size, [&](const Point<2>& p) {
    const GridSize<2> cell = cellOf<2>(
      { (1.0 - p[0]) * static_cast<double>(size[0]), p[1] * static_cast<double>(size[1]) }, size);
    return density.Values[static_cast<std::size_t>(cellIndex<2>(cell, size))];
  });
  const TestDensity<2> turned = sampleDensity<2>({ size[1], size[0] }, [&](const Point<2>& p) {
    const GridSize<2> cell = cellOf<2>(
      { p[1] * static_cast<double>(size[0]), (1.0 - p[0]) * static_cast<double>(size[1]) }, size);
    return density.Values[static_cast<std::size_t>(cellIndex<2>(cell, size))];
  });
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    for (const double particles : { 0.0, 20000.0 })
    {
      FlowOptions options;
      options.Particles = particles;
      const StepChoice choice = choiceOf<2>(density, direction, options);
      for (const TestDensity<2>& other : { mirrored, turned })
      {
        const StepChoice same = choiceOf<2>(other, direction, options);
        EXPECT_EQ(same.NumberOfSteps, choice.NumberOfSteps);
        EXPECT_NEAR(same.AreaError, choice.AreaError, 1e-3 * choice.AreaError);
      }
    }
  }
}

// With the usual tolerance no run costs more than eight times one with the fewest steps.
TEST(AutomaticSteps, Limit)
{
  const TestDensity<2> circle = thinCircle();
  const RectifiedFlow<2> flow = makeFlow(circle);
  const Points<2> seeds = cornerLattice<2>(circle.Size);
  Points<2> positions(seeds.size());
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const auto run = [&](const FlowOptions& options) {
      return direction == FlowDirection::Backward ? flow.Backward(seeds, positions, options)
                                                  : flow.Forward(seeds, positions, options);
    };
    const FlowReport fewest = run(steps(32));
    const FlowReport report = run({});
    EXPECT_GT(report.NumberOfSteps, 64);
    EXPECT_LE(report.Evaluations, 8 * fewest.Evaluations);
    EXPECT_GT(report.AreaError, FlowOptions::UsualTolerance);
    EXPECT_GT(report.StepsNeeded, report.NumberOfSteps);
    EXPECT_GT(report.TimesNeeded, 1.0);
    EXPECT_GT(flow.ChooseSteps(within(0.021), direction).NumberOfSteps, 2 * report.NumberOfSteps);
  }
}

// Who needs more steps in any case has a higher limit; which run comes first makes no difference.
TEST(AutomaticSteps, LimitOfEachLeast)
{
  const TestDensity<2> density = thinCircle();
  FlowOptions few;
  FlowOptions many;
  many.LeastSteps = 256;
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const auto after = [&](const FlowOptions& first, const FlowOptions& then) {
      const RectifiedFlow<2> flow = makeFlow(density);
      flow.ChooseSteps(first, direction);
      return flow.ChooseSteps(then, direction).NumberOfSteps;
    };
    EXPECT_GT(after(few, many), 2 * after(few, few));
    EXPECT_EQ(after(few, many), after(many, many));
    EXPECT_EQ(after(many, few), after(few, few));
  }
}

// Each axis of a density of one, two or three, with any number of cells.
TEST(AutomaticSteps, EveryShape)
{
  const auto isUsual = [](const StepChoice& choice) {
    return choice.NumberOfSteps >= 32 && choice.NumberOfSteps <= 4096;
  };
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    for (const std::int64_t side : { 1, 2, 3, 5, 300 })
    {
      EXPECT_TRUE(isUsual(choiceOf<1>(randomCells<1>({ side }, 0.0), direction)));
      EXPECT_TRUE(isUsual(choiceOf<2>(randomCells<2>({ side, 3 }, 0.0), direction)));
      EXPECT_TRUE(isUsual(choiceOf<3>(randomCells<3>({ 2, side, 4 }, 0.0), direction)));
    }
    // No block counts.
    TestDensity<2> lonely = uniformDensity<2>({ 40, 40 });
    std::fill(lonely.Values.begin(), lonely.Values.end(), 0.0);
    lonely.Values[777] = 1.0;
    EXPECT_TRUE(isUsual(choiceOf<2>(lonely, direction)));
  }
}

TEST(AutomaticSteps, WhatCannotBeReached)
{
  const StepChoice choice =
    choiceOf<2>(spike(), FlowDirection::Backward, within(0.01, Integrator::Euler));
  EXPECT_EQ(choice.NumberOfSteps, 4096);
  EXPECT_GT(choice.AreaError, 0.01);
  EXPECT_GT(choice.StepsNeeded, 4096);
}

// A run with 0 steps is one with those that are chosen, and says so.
TEST(AutomaticSteps, Reports)
{
  const TestDensity<2> density = denseBall<2>(128, 100.0);
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 500);
  Points<2> positions(seeds.size());
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const bool isBackward = direction == FlowDirection::Backward;
    const StepChoice choice = flow.ChooseSteps({}, direction);
    const FlowReport report =
      isBackward ? flow.Backward(seeds, positions) : flow.Forward(seeds, positions);
    EXPECT_EQ(report.NumberOfSteps, choice.NumberOfSteps);
    EXPECT_EQ(report.AreaError, choice.AreaError);
    FlowOptions fixed = steps(choice.NumberOfSteps);
    fixed.MapSteps = choice.MapSteps;
    EXPECT_TRUE(sameBits<2>(
      positions, isBackward ? runBackward(flow, seeds, fixed) : runForward(flow, seeds, fixed)));
    const FlowReport given = isBackward ? flow.Backward(seeds, positions, steps(48))
                                        : flow.Forward(seeds, positions, steps(48));
    EXPECT_EQ(given.NumberOfSteps, 48);
    EXPECT_TRUE(std::isnan(given.AreaError));
  }
  FlowOptions atLeast;
  atLeast.LeastSteps = 3000;
  EXPECT_EQ(flow.Backward(seeds, positions, atLeast).NumberOfSteps, 3000);
  FlowOptions nearest;
  nearest.Lookup = TableLookup::Nearest;
  EXPECT_EQ(flow.Backward(seeds, positions, nearest).NumberOfSteps, 32);
  EXPECT_EQ(flow.Backward(seeds, positions, adaptive(0.01)).NumberOfSteps, 0);
  std::vector<std::int64_t> cells(seeds.size());
  EXPECT_EQ(flow.ForwardToCells(seeds, cells.data()).NumberOfSteps, 128);
  const PivotLattice<2> pivot = pivotLattice<2>({ 20, 20 }, 4);
  Points<2> particles(static_cast<std::size_t>(pivot.NumberOfParticles()));
  const FlowReport morph = transportPivot<2>(flow, pivot, particles);
  FlowOptions ofPivot;
  ofPivot.Particles = static_cast<double>(particles.size());
  const StepChoice choice = flow.ChooseSteps(ofPivot, FlowDirection::Forward);
  EXPECT_EQ(morph.NumberOfSteps, choice.NumberOfSteps);
  EXPECT_EQ(morph.AreaError, choice.AreaError);
  EXPECT_GT(morph.AreaError, 0.0);
}

// The steps of the published schemes are uniform; those of first order need the most.
TEST(AutomaticSteps, OtherIntegrators)
{
  const TestDensity<2> density = denseBall<2>(64, 100.0);
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const auto of = [&](Integrator method) {
      return choiceOf<2>(density, direction, within(0.021, method)).NumberOfSteps;
    };
    EXPECT_GT(of(Integrator::RungeKutta4), 32);
    EXPECT_GT(of(Integrator::Euler), 2 * of(Integrator::RungeKutta4));
  }
}

// A choice is made once for a density: later ones take no work that could be cancelled.
TEST(AutomaticSteps, AreKept)
{
  const TestDensity<2> density = denseBall<2>(128, 100.0);
  const RectifiedFlow<2> flow = makeFlow(density);
  const SerialExecutor serial;
  const Context cancelled(serial, {}, []() { return true; });
  const auto choose = [&](const FlowOptions& options) {
    return flow.ChooseSteps(options, FlowDirection::Backward, cancelled);
  };
  EXPECT_THROW(choose({}), Cancelled);
  const StepChoice first = flow.ChooseSteps({}, FlowDirection::Backward);
  EXPECT_EQ(choose({}).NumberOfSteps, first.NumberOfSteps);
  EXPECT_EQ(choose({}).AreaError, first.AreaError);
  EXPECT_THROW(choose(within(0.01)), Cancelled);
  EXPECT_THROW(flow.ChooseSteps({}, FlowDirection::Forward, cancelled), Cancelled);
}

template <int Dimension>
void expectSameOnRanks(const TestDensity<Dimension>& density, const TileLimits& limits)
{
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const ThreadsExecutor threads(3);
    const StepChoice whole = choiceOf<Dimension>(density, direction);
    EXPECT_EQ(choiceOf<Dimension>(density, direction, {}, threads).AreaError, whole.AreaError);
    const TiledRun<Dimension> tiled(density, limits);
    const StepChoice alone = tiled.Flow.ChooseSteps({}, direction);
    EXPECT_GT(alone.AreaError, 0.0);
    EXPECT_NEAR(
      std::log2(static_cast<double>(alone.NumberOfSteps) / whole.NumberOfSteps), 0.0, 1.0);
    for (const int count : { 1, 3 })
    {
      runOnRanks(count, [&](const Ranks& ranks) {
        Context context;
        context.Group = &ranks;
        const RectifiedFlow<Dimension> flow(density.Source(), context);
        EXPECT_EQ(flow.ChooseSteps({}, direction, context).AreaError, whole.AreaError);
        const BoxesOfDensity<Dimension> boxes(density, ranks);
        const RectifiedFlow<Dimension> inTiles(
          DensitySource<Dimension>(density.Size, boxes), FlowTables::Tiled, context, limits);
        const StepChoice shared = inTiles.ChooseSteps({}, direction, context);
        EXPECT_EQ(shared.NumberOfSteps, alone.NumberOfSteps);
        EXPECT_EQ(shared.AreaError, alone.AreaError);
      });
    }
  }
}

TEST(AutomaticSteps, SameOnRanksAndThreads)
{
  expectSameOnRanks<2>(denseBall<2>(100, 100.0), manyTiles<2>());
  expectSameOnRanks<3>(denseBall<3>(28, 30.0), manyTiles<3>());
  expectSameOnRanks<2>(smallDisc(200, 0.0), manyTiles<2>());
}

// Corners of a box that is stretched, turned and sheared have its volume; turned over, the
// negative one.
TEST(ImageMeasure, LinearMaps)
{
  const double matrix[3][3] = { { 2.0, 0.5, 0.1 }, { -0.3, 1.5, 0.7 }, { 0.2, -0.4, 3.0 } };
  const double determinant =
    2.0 * (1.5 * 3.0 + 0.4 * 0.7) - 0.5 * (-0.3 * 3.0 - 0.2 * 0.7) + 0.1 * (0.3 * 0.4 - 0.2 * 1.5);
  Point<3> corners[8];
  Point<3> mirrored[8];
  for (std::size_t i = 0; i < 8; ++i)
  {
    const double x[3] = { static_cast<double>(i & 1), static_cast<double>(i >> 1 & 1),
      static_cast<double>(i >> 2) };
    for (std::size_t r = 0; r < 3; ++r)
    {
      corners[i][r] = 5.0 + matrix[r][0] * x[0] + matrix[r][1] * x[1] + matrix[r][2] * x[2];
    }
    mirrored[i] = { corners[i][1], corners[i][0], corners[i][2] };
  }
  EXPECT_NEAR(imageMeasure<3>(corners), determinant, 1e-12);
  EXPECT_NEAR(imageMeasure<3>(mirrored), -determinant, 1e-12);
  const Point<2> square[4] = { { 1.0, 1.0 }, { 3.0, 1.5 }, { 0.5, 4.0 }, { 2.5, 4.5 } };
  EXPECT_NEAR(imageMeasure<2>(square), 2.0 * 3.0 + 0.5 * 0.5, 1e-12);
  const Point<1> line[2] = { { 7.0 }, { 4.0 } };
  EXPECT_EQ(imageMeasure<1>(line), -3.0);
}

// Against an integration with many points.
TEST(ImageMeasure, TrilinearMap)
{
  Point<3> corners[8];
  for (std::size_t i = 0; i < 8; ++i)
  {
    corners[i] = { static_cast<double>(i & 1), static_cast<double>(i >> 1 & 1),
      static_cast<double>(i >> 2) };
  }
  corners[7] = { 1.4, 1.3, 1.7 };
  corners[2] = { -0.2, 1.1, 0.3 };
  constexpr int points = 40;
  const auto place = [&](double u, double v, double w) {
    Point<3> x{};
    for (std::size_t i = 0; i < 8; ++i)
    {
      const double weight = ((i & 1) != 0 ? u : 1.0 - u) * ((i >> 1 & 1) != 0 ? v : 1.0 - v) *
        (i >> 2 != 0 ? w : 1.0 - w);
      for (std::size_t r = 0; r < 3; ++r)
      {
        x[r] += weight * corners[i][r];
      }
    }
    return x;
  };
  double sum = 0.0;
  for (int i = 0; i < points * points * points; ++i)
  {
    const double u = (i % points + 0.5) / points;
    const double v = (i / points % points + 0.5) / points;
    const double w = (i / points / points + 0.5) / points;
    constexpr double h = 0.25; // the map is linear along each axis
    double d[3][3];
    for (std::size_t r = 0; r < 3; ++r)
    {
      d[0][r] = (place(u + h, v, w)[r] - place(u - h, v, w)[r]) / (2.0 * h);
      d[1][r] = (place(u, v + h, w)[r] - place(u, v - h, w)[r]) / (2.0 * h);
      d[2][r] = (place(u, v, w + h)[r] - place(u, v, w - h)[r]) / (2.0 * h);
    }
    sum += d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
      d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
      d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
  }
  EXPECT_NEAR(imageMeasure<3>(corners), sum / (points * points * points), 1e-4);
}

} // namespace
} // namespace RectifiedTransport
