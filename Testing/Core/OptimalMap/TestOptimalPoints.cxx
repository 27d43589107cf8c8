// SPDX-License-Identifier: BSD-3-Clause
// The optimal map at points: known maps, costs, masses, bits, and what it refuses.
#include "OptimalMap/MapPoints.h"
#include "RecordingContext.h"
#include "TestDensities.h"
#include "TestDimensions.h"
#include "TestRefusal.h"
#include "ThreadRanks.h"
#include "ThreadsExecutor.h"

#include "Core/Flow/RectifiedFlow.h"
#include "Core/OptimalMap/OptimalMap.h"
#include "Core/Parallel/RankShare.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport
{

template <class T>
using OptimalPoints = DimensionTest<T>;
TYPED_TEST_SUITE(OptimalPoints, Dimensions);

TYPED_TEST(OptimalPoints, AreAtRestForAUniformDensity)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(20);
  const OptimalMap<D> map = solvedMap<D>(uniformDensity<D>(size, 3.0));
  const Points<D> seeds = latticePoints<D>(size, 7);
  Points<D> images(seeds.size());
  map.Forward(seeds, images);
  EXPECT_LT(meanSquare<D>(seeds, images, size), 1e-24);
  EXPECT_EQ(map.LowerBound(), 0.0);
}

TYPED_TEST(OptimalPoints, OfATranslatedBallAreTranslated)
{
  constexpr int D = TypeParam::value;
  // Whole cells apart.
  const GridSize<D> size = evenSize<D>(D == 1 ? 240 : D == 2 ? 80 : 32);
  Point<D> from = evenPoint<D>(0.25);
  Point<D> to = evenPoint<D>(0.75);
  to[0] = 0.625;
  const TestDensity<D> source = ballAt<D>(size, from);
  const OptimalMap<D> map = solvedPair<D>(source, ballAt<D>(size, to));
  double exact = 0.0;
  for (int axis = 0; axis < D; ++axis)
  {
    exact += (to[axis] - from[axis]) * (to[axis] - from[axis]);
  }
  EXPECT_LE(map.LowerBound(), exact * (1.0 + 1e-12));
  EXPECT_GE(map.LowerBound(), exact * 0.99);
  EXPECT_GE(map.UpperBound(), exact * (1.0 - 1e-12));

  Points<D> inside;
  for (const Point<D>& point : latticePoints<D>(size, 3 * sideFor<D>() / 2))
  {
    if (source.Values[static_cast<std::size_t>(cellIndex<D>(cellOf<D>(point, size), size))] > 0.0)
    {
      inside.push_back(point);
    }
  }
  ASSERT_GT(inside.size(), 30u);
  Points<D> images(inside.size());
  map.Forward(inside, images);
  double error = 0.0;
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      const double way = (to[axis] - from[axis]) * static_cast<double>(size[axis]);
      error += std::abs(images[i][axis] - inside[i][axis] - way);
    }
  }
  EXPECT_LT(error / static_cast<double>(inside.size()), D == 3 ? 0.3 : 0.1) << "cells";
  EXPECT_NEAR(meanSquare<D>(inside, images, size) / exact, 1.0, D == 3 ? 0.012 : 0.002);
}

TYPED_TEST(OptimalPoints, CostLittleMoreThanTheBoundAndLessThanTheFlow)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>());
  const TestDensity<D> density = twoGaussians<D>(size);
  const OptimalMap<D> map = solvedMap<D>(density);
  const Points<D> seeds = latticePoints<D>(size, 2 * sideFor<D>());
  Points<D> images(seeds.size());
  map.Forward(seeds, images);
  const double cost = meanSquare<D>(seeds, images, size);
  const double bound = map.LowerBound();
  EXPECT_LE(cost, bound * (D == 3 ? 1.012 : 1.003));
  EXPECT_GE(cost, bound * 0.999);
  std::vector<double> slack(seeds.size());
  map.Slack(seeds, images, slack.data());
  double mean = 0.0;
  for (const double s : slack)
  {
    ASSERT_GE(s, 0.0);
    mean += s / static_cast<double>(slack.size());
  }
  EXPECT_NEAR(bound + 2.0 * mean, cost, 0.03 * cost);
  EXPECT_LT(map.MassError(), 0.05);

  Points<D> flowed(seeds.size());
  const auto values = density.Source();
  RectifiedFlow<D>(values).Forward(seeds, flowed);
  const double flow = meanSquare<D>(seeds, flowed, size);
  EXPECT_LE(bound, flow);
  EXPECT_LE(cost, flow * (D == 1 ? 1.001 : 1.0)); // on a line the flow is optimal
  std::vector<double> more(seeds.size());
  map.Slack(seeds, flowed, more.data());
  double meanOfFlow = 0.0;
  for (const double s : more)
  {
    meanOfFlow += s / static_cast<double>(more.size());
  }
  EXPECT_GE(meanOfFlow, mean * (D == 1 ? 0.9 : 1.0));
}

TYPED_TEST(OptimalPoints, ComeBack)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>());
  const OptimalMap<D> map = solvedMap<D>(twoGaussians<D>(size));
  const Points<D> seeds = latticePoints<D>(size, sideFor<D>());
  Points<D> images(seeds.size());
  map.Forward(seeds, images);
  map.Backward(images, images); // in place
  EXPECT_LT(std::sqrt(meanSquare<D>(seeds, images, size)) * static_cast<double>(size[0]), 0.25)
    << "cells";
}

TYPED_TEST(OptimalPoints, AsSamplesGiveBoxesTheirCounts)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>() / 2 * 2);
  const TestDensity<D> density = discWithHole<D>(size);
  const OptimalMap<D> map = solvedMap<D>(density);
  const Points<D> seeds = latticePoints<D>(size, sideFor<D>());
  Points<D> alone(seeds.size());
  map.Forward(seeds, alone);
  Points<D> together(seeds.size());
  map.Forward(FlowSeeds<D>(seeds).AsSamples(), together);
  EXPECT_FALSE(haveSameBits<D>(alone, together));
  // Halves across the first axis, which the halving makes exact.
  double share = 0.0;
  double all = 0.0;
  for (std::int64_t i = 0; i < cellCount<D>(size); ++i)
  {
    const double value = density.Values[static_cast<std::size_t>(i)];
    all += value;
    share += 2 * cellAt<D>(i, size)[0] < size[0] ? value : 0.0;
  }
  std::int64_t count = 0;
  for (const Point<D>& point : together)
  {
    ASSERT_GT(
      density.Values[static_cast<std::size_t>(cellIndex<D>(cellOf<D>(point, size), size))], 0.0);
    count += 2.0 * point[0] < static_cast<double>(size[0]) ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(count), static_cast<double>(together.size()) * share / all, 1.0);
  const double cost = meanSquare<D>(seeds, together, size);
  EXPECT_LE(cost, map.LowerBound() * (D == 3 ? 1.03 : 1.01));
}

TYPED_TEST(OptimalPoints, BetweenTheTimesAreOnStraightLines)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(24);
  const OptimalMap<D> map = solvedMap<D>(twoGaussians<D>(size));
  const Points<D> seeds = latticePoints<D>(size, 5);
  Points<D> images(seeds.size());
  map.Forward(seeds, images);
  Points<D> between(3 * seeds.size());
  map.ForwardAt(seeds, { 0.0, 0.25, 1.0 }, between);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      const double x = seeds[i][axis];
      const double y = images[i][axis];
      EXPECT_NEAR(between[3 * i][axis], x, 1e-12);
      EXPECT_NEAR(between[3 * i + 1][axis], x + 0.25 * (y - x), 1e-12);
      EXPECT_NEAR(between[3 * i + 2][axis], y, 1e-12);
    }
  }
  std::vector<std::int64_t> cells(seeds.size());
  map.ForwardToCells(seeds, cells.data());
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    EXPECT_EQ(cells[i], cellIndex<D>(cellOf<D>(images[i], size), size));
  }
}

TYPED_TEST(OptimalPoints, HaveTheSameBitsOnAnyThreadsAndRanks)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>());
  for (const bool hasVoids : { false, true })
  {
    const TestDensity<D> density = hasVoids ? discWithHole<D>(size) : twoGaussians<D>(size);
    const Points<D> seeds = latticePoints<D>(size, sideFor<D>());
    Points<D> expected(seeds.size());
    double bound = 0.0;
    for (const int threads : { 1, 2, 3 })
    {
      const ThreadsExecutor executor(threads);
      const OptimalMap<D> map = solvedMap<D>(density, evenPoint<D>(1.0), Context(executor));
      Points<D> images(seeds.size());
      map.Forward(FlowSeeds<D>(seeds).AsSamples(), images, Context(executor));
      if (threads == 1)
      {
        expected = images;
        bound = map.LowerBound();
      }
      EXPECT_TRUE(haveSameBits<D>(images, expected)) << threads << " threads";
      EXPECT_EQ(map.LowerBound(), bound) << threads << " threads";
    }
    for (const int count : { 2, 3 })
    {
      runOnRanks(count, [&](const Ranks& ranks) {
        Context context;
        context.Group = &ranks;
        const RankShare share(static_cast<std::int64_t>(seeds.size()), ranks);
        const OptimalMap<D> map = solvedMap<D>(density, evenPoint<D>(1.0), context);
        Points<D> images(static_cast<std::size_t>(share.Count));
        const FlowSeeds<D> own(seeds[static_cast<std::size_t>(share.First)].data(), share.Count);
        map.Forward(own.AsSamples(), images, context);
        EXPECT_EQ(std::memcmp(
                    images.data(), expected.data() + share.First, images.size() * sizeof(Point<D>)),
          0)
          << count << " ranks";
      });
    }
  }
}

TYPED_TEST(OptimalPoints, ReachSingleCellsCornersAndHighContrast)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(9);
  GridSize<D> inner = evenSize<D>(3);
  inner[0] = 7;
  TestDensity<D> contrast = randomCells<D>(size);
  for (double& value : contrast.Values)
  {
    value = std::pow(10.0, -16.0 * value);
  }
  for (const TestDensity<D>& density :
    { dirac<D>(size, inner), dirac<D>(size, {}), contrast, uniformDensity<D>(evenSize<D>(1)) })
  {
    const OptimalMap<D> map = solvedMap<D>(density);
    const Points<D> seeds = latticePoints<D>(density.Size, 8);
    Points<D> images(seeds.size());
    map.Forward(FlowSeeds<D>(seeds).AsSamples(), images);
    for (const Point<D>& image : images)
    {
      for (int axis = 0; axis < D; ++axis)
      {
        ASSERT_TRUE(image[axis] >= 0.0 && image[axis] <= static_cast<double>(density.Size[axis]));
      }
      ASSERT_GT(density.Values[static_cast<std::size_t>(
                  cellIndex<D>(cellOf<D>(image, density.Size), density.Size))],
        0.0);
    }
    const auto values = density.Source();
    Points<D> flowed(seeds.size());
    RectifiedFlow<D>(values).Forward(seeds, flowed);
    EXPECT_LE(map.LowerBound(), meanSquare<D>(seeds, flowed, density.Size) + 0.02);
    EXPECT_TRUE(std::isfinite(map.LowerBound()));
    EXPECT_TRUE(std::isfinite(map.UpperBound()));
  }
}

TYPED_TEST(OptimalPoints, AreRefusedWhereNothingCanBeMoved)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = twoGaussians<D>(evenSize<D>(8));
  const auto values = density.Source();
  const Point<D> sides = evenPoint<D>(1.0);
  OptimalMapOptions options;
  options.Tolerance = 0.0;
  EXPECT_NE(refusal([&]() { OptimalMap<D>(values, sides, options); }).find("above 0 and below 1"),
    std::string::npos);
  options = {};
  options.MostIterations = 3;
  EXPECT_NE(refusal([&]() { OptimalMap<D>(values, sides, options); }).find("must ascend"),
    std::string::npos);
  EXPECT_NE(refusal([&]() { OptimalMap<D>(values, evenPoint<D>(0.0)); }).find("side of 0"),
    std::string::npos);
  const OptimalMap<D> map = solvedMap<D>(density);
  const Points<D> seeds = latticePoints<D>(density.Size, 4);
  Points<D> few(1);
  EXPECT_NE(
    refusal([&]() { map.Forward(seeds, few); }).find("memory for 1 positions"), std::string::npos);
  EXPECT_NE(refusal([&]() {
    map.ForwardAt(seeds, { 0.5, 0.2 }, few);
  }).find("must ascend"),
    std::string::npos);
  std::vector<double> slack(seeds.size());
  EXPECT_NE(refusal([&]() { map.Slack(seeds, few, slack.data()); }).find("as many of both"),
    std::string::npos);
  TestDensity<D> wrong = density;
  wrong.Values[3] = std::numeric_limits<double>::quiet_NaN();
  const auto bad = wrong.Source();
  EXPECT_THROW(OptimalMap<D>(bad, sides), InvalidDensity);
  if (D > 1)
  {
    Point<D> thin = sides;
    thin[0] = 1e-130;
    EXPECT_NE(
      refusal([&]() { OptimalMap<D>(density.Source(), thin); }).find("longest side of the domain"),
      std::string::npos);
  }
  const TestDensity<D> other = twoGaussians<D>(evenSize<D>(9));
  EXPECT_NE(refusal([&]() { solvedPair<D>(density, other).UpperBound(); }).find("same number"),
    std::string::npos);
}

TYPED_TEST(OptimalPoints, ReportProgressAndStop)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = twoGaussians<D>(evenSize<D>(sideFor<D>()));
  const auto values = density.Source();
  const SerialExecutor executor;
  RecordingContext recording(executor);
  OptimalMap<D> map(values, evenPoint<D>(1.0), {}, recording.Context());
  recording.ExpectReported(0.0, 1.0);
  map.Solve(recording.Context());
  recording.ExpectReported(0.0, 1.0);
  const Points<D> seeds = latticePoints<D>(density.Size, 10);
  Points<D> images(seeds.size());
  map.Forward(FlowSeeds<D>(seeds).AsSamples(), images, recording.Context());
  recording.ExpectReported(0.0, 1.0);
  const int queries = recording.Queries;
  for (const int part : { 1, 2 })
  {
    RecordingContext stopped(executor);
    stopped.MaximumQueries = queries * part / 4;
    EXPECT_THROW(
      {
        OptimalMap<D> again(values, evenPoint<D>(1.0), {}, stopped.Context());
        again.Solve(stopped.Context());
        again.Forward(seeds, images, stopped.Context());
      },
      Cancelled);
  }
}

// Turned Gaussians, whose distance is that of Bures: tr A + tr B - 2 tr (A^(1/2) B A^(1/2))^(1/2).
TEST(OptimalPoints2D, OfTurnedGaussiansCostTheirDistance)
{
  const double large = 0.0036;
  const double small = 0.0009;
  const double turn = 1.0;
  const auto gaussian = [&](double angle) {
    return sampleDensity<2>({ 128, 128 }, [=](const Point<2>& p) {
      const double x = std::cos(angle) * (p[0] - 0.5) + std::sin(angle) * (p[1] - 0.5);
      const double y = std::cos(angle) * (p[1] - 0.5) - std::sin(angle) * (p[0] - 0.5);
      return std::exp(-x * x / (2.0 * large) - y * y / (2.0 * small));
    });
  };
  const double c = std::cos(turn) * std::cos(turn);
  const double traceOfProduct = (large * large + small * small) * c + 2.0 * large * small * (1 - c);
  const double exact =
    2.0 * (large + small) - 2.0 * std::sqrt(traceOfProduct + 2.0 * large * small);
  const OptimalMap<2> map = solvedPair<2>(gaussian(0.3), gaussian(0.3 + turn));
  EXPECT_LE(map.LowerBound(), exact * 1.0001); // the densities are sampled
  EXPECT_GE(map.LowerBound(), exact * 0.96);
  EXPECT_GE(map.UpperBound(), exact * 0.9999);
}

// Two boxes: the densities are the same cells moved.
TEST(OptimalPoints2D, OfDifferentBoxesGoFromOneToTheOther)
{
  const TestDensity<2> density = twoGaussians<2>({ 32, 24 });
  const auto values = density.Source();
  const DensitySource<2> source(density.Size, values);
  OptimalMap<2> map({ source, { 0.0, 0.0 }, { 4.0, 3.0 } }, { source, { 3.0, 1.0 }, { 7.0, 4.0 } });
  map.Solve();
  EXPECT_LE(map.LowerBound(), 10.0);
  EXPECT_GE(map.LowerBound(), 9.9);
  const Points<2> seeds = latticePoints<2>(density.Size, 20);
  Points<2> images(seeds.size());
  map.Forward(seeds, images);
  EXPECT_LT(std::sqrt(meanSquare<2>(seeds, images, { 1, 1 })), 0.2) << "cells";
}

} // namespace RectifiedTransport
