// SPDX-License-Identifier: BSD-3-Clause
// Blue noise through optimal transport: what it does to points, and for which inputs.
#include "Core/Relaxation/BlueNoiseRelaxation.h"

#include "RecordingContext.h"
#include "TestRefusal.h"
#include "TestRelaxation.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace RectifiedTransport
{
namespace
{

RelaxationReport relax(const TestDensity<2>& density, Points<2>& points,
  const RelaxationOptions& options = {}, const Context& context = Context(),
  const Point<2>& spacing = { 1.0, 1.0 })
{
  return relaxByTransport(density.Source(), spacing, points, options, context);
}

const auto relaxIn = [](const TestDensity<2>& density, Points<2>& points,
                       const RelaxationOptions& options,
                       const Context& context) { return relax(density, points, options, context); };

void fillBlock(
  TestDensity<2>& density, const GridSize<2>& first, const GridSize<2>& size, double value)
{
  for (std::int64_t row = first[1]; row < first[1] + size[1]; ++row)
  {
    const auto begin = static_cast<std::ptrdiff_t>(row * density.Size[0] + first[0]);
    std::fill_n(density.Values.begin() + begin, size[0], value);
  }
}

TEST(Transport, RandomPointsBecomeBlueNoise)
{
  const TestDensity<2> density = uniformDensity<2>({ 64, 64 });
  Points<2> points = randomPoints<2>(density.Size, 1024);
  const RelaxationReport report = relax(density, points, iterations(20));
  expectDescent<2>(report, points, density.Size);
  EXPECT_GT(report.Energy.front(), 0.2);
  EXPECT_LT(report.Energy.back(), 0.166);
  EXPECT_GT(report.Energy.back(), 5.0 / (18.0 * std::sqrt(3.0))); // the hexagonal lattice's
  const ParticleQuality quality = qualityOf<2>(density, points);
  EXPECT_GT(quality.MeanSpacing, 0.88);
  EXPECT_GT(quality.SmallestSpacing, 0.5);
}

TEST(Transport, ImprovesWhatTheFlowMakes)
{
  const TestDensity<2> density = twoGaussians<2>({ 96, 80 });
  Points<2> points = flowStart<2>(density, 600);
  const ParticleQuality before = qualityOf<2>(density, points, 12);
  const double energyBefore = quantisation(density, points);
  const RelaxationReport report = relax(density, points, iterations(10));
  expectDescent<2>(report, points, density.Size);
  const ParticleQuality after = qualityOf<2>(density, points, 12);
  EXPECT_LT(quantisation(density, points), 0.96 * energyBefore);
  EXPECT_GT(after.MeanSpacing, before.MeanSpacing);
  EXPECT_LT(after.DensityError, before.DensityError);
}

// The least energy of points in a row is that of the middles of equal parts; equal parts of one
// mass at two points are what the energy before the first iteration is of.
TEST(Transport, EnergyIsThatOfEqualMasses)
{
  const TestDensity<2> density = uniformDensity<2>({ 8, 4 });
  Points<2> points = { { 1.0, 2.0 }, { 3.0, 2.0 } };
  const RelaxationReport report = relax(density, points, iterations(50));
  // Each half of the domain goes to its point: N / (M A) times the integral of |x - point|^2.
  const double across = 32.0 * 16.0 / 12.0;
  const double left = 4.0 * (27.0 + 1.0) / 3.0;
  const double right = 4.0 * (125.0 - 1.0) / 3.0;
  EXPECT_NEAR(report.Energy.front(), 2.0 * (across + left + right) / (32.0 * 32.0), 1e-9);
  const double best = 2.0 * (across + 2.0 * 16.0 * 16.0 / 12.0) / (32.0 * 32.0);
  EXPECT_NEAR(report.Energy.back(), best, 1e-6);
  EXPECT_NEAR(points[0][0], 2.0, 1e-2);
  EXPECT_NEAR(points[1][0], 6.0, 1e-2);
}

// The domain is not square, nor are its cells: the energy has no unit.
TEST(Transport, SeesPhysicalSpace)
{
  const TestDensity<2> coarse = twoGaussians<2>({ 40, 20 });
  TestDensity<2> fine = uniformDensity<2>({ 40, 40 });
  for (std::size_t i = 0; i < fine.Values.size(); ++i)
  {
    fine.Values[i] = coarse.Values[i % 40 + i / 80 * 40];
  }
  Points<2> first = randomPoints<2>(coarse.Size, 200);
  Points<2> second = first;
  for (Point<2>& point : second)
  {
    point[1] *= 2.0;
  }
  const RelaxationReport report =
    relax(coarse, first, iterations(5), Context(), Point<2>{ 0.3, 0.6 });
  const RelaxationReport other = relax(fine, second, iterations(5));
  ASSERT_EQ(report.Energy.size(), other.Energy.size());
  for (std::size_t i = 0; i < report.Energy.size(); ++i)
  {
    EXPECT_NEAR(report.Energy[i], other.Energy[i], 1e-6 * other.Energy[i]);
  }
  for (Point<2>& point : second)
  {
    point[1] *= 0.5;
  }
  EXPECT_LT(largestDistance<2>(first, second), 1e-4);
}

TEST(Transport, SameBitsOnAnyThreads)
{
  expectSameBitsOnAnyThreads(relaxIn, 4);
}

TEST(Transport, FollowsTheOrderOfThePoints)
{
  expectAnyOrder(relaxIn, 5);
}

// From anywhere, points come to where the density has mass, and stay there.
TEST(Transport, LeavesHoles)
{
  const TestDensity<2> density = discWithHole<2>({ 64, 64 });
  Points<2> points = randomPoints<2>(density.Size, 200);
  EXPECT_GT(qualityOf<2>(density, points).InEmptyCells, 75);
  expectDescent<2>(relax(density, points, iterations(4)), points, density.Size);
  const ParticleQuality after = qualityOf<2>(density, points);
  EXPECT_EQ(after.InEmptyCells, 0);
  EXPECT_GT(after.MeanSpacing, 0.75);
}

// One point between parts that the others are in: it leaves, and does not hold the others.
TEST(Transport, OnePointInAHole)
{
  TestDensity<2> density = uniformDensity<2>({ 90, 30 }, 0.0);
  fillBlock(density, { 0, 0 }, { 25, 30 }, 1.0);
  fillBlock(density, { 60, 0 }, { 25, 30 }, 1.0);
  Points<2> points = flowStart<2>(density, 100);
  points.push_back({ 40.0, 12.5 });
  const RelaxationReport report = relax(density, points, iterations(5));
  EXPECT_EQ(report.Energy.size(), 6u);
  EXPECT_LT(report.Energy.back(), report.Energy.front() - 0.02);
  EXPECT_EQ(qualityOf<2>(density, points).InEmptyCells, 0);
}

// Few points for two single cells of mass, one of them in the corner of the domain.
TEST(Transport, LeavesHolesForTheCorner)
{
  TestDensity<2> density = uniformDensity<2>({ 64, 64 }, 0.0);
  density.Values[0] = 1.0;
  density.Values[32 * 64 + 32] = 1.0;
  for (const std::size_t count : { 9u, 11u })
  {
    for (std::uint64_t seed = 0; seed < 2; ++seed)
    {
      Points<2> points = randomPoints<2>(density.Size, count, seed);
      expectDescent<2>(relax(density, points, iterations(30)), points, density.Size);
      EXPECT_LE(qualityOf<2>(density, points).InEmptyCells, 1) << count << ", seed " << seed;
    }
  }
}

// The centroids of a frame's corners are not in it.
TEST(Transport, LeavesAHoleForItsRim)
{
  TestDensity<2> density = uniformDensity<2>({ 20, 20 });
  fillBlock(density, { 1, 1 }, { 18, 18 }, 0.0);
  Points<2> points = randomPoints<2>({ 10, 10 }, 12);
  for (Point<2>& point : points)
  {
    point = { point[0] + 5.0, point[1] + 5.0 };
  }
  ASSERT_EQ(relax(density, points, iterations(1)).Energy.size(), 2u);
  EXPECT_EQ(qualityOf<2>(density, points).InEmptyCells, 0);
}

TEST(Transport, ArrivesInACorner)
{
  const TestDensity<2> density = dirac<2>({ 20, 20 }, { 0, 0 });
  Points<2> points = randomPoints<2>(density.Size, 5);
  relax(density, points, iterations(1));
  EXPECT_EQ(qualityOf<2>(density, points).InEmptyCells, 0);
}

// Thin beyond what numbers tell apart: as good as a line.
TEST(Transport, DomainLikeALine)
{
  const TestDensity<2> density = uniformDensity<2>({ 8, 8 });
  for (const Point<2>& spacing : { Point<2>{ 1.0, 1e-70 }, { 1e-20, 1.0 } })
  {
    Points<2> points = randomPoints<2>(density.Size, 10);
    const RelaxationReport report = relax(density, points, iterations(20), Context(), spacing);
    expectDescent<2>(report, points, density.Size);
    EXPECT_LT(report.Energy.back(), 0.5 * report.Energy.front());
  }
}

// Copies that differ by rounding, and points so near that their bisectors have no digits.
TEST(Transport, NearlyCoincidentPoints)
{
  const TestDensity<2> density = twoGaussians<2>({ 40, 40 });
  for (const double apart : { 1e-15, 1e-11, 1e-7 })
  {
    Points<2> points = randomPoints<2>(density.Size, 40);
    for (std::size_t i = 0; i < 20; ++i)
    {
      const Point<2> copied = points[i];
      points.push_back({ copied[0] * (1.0 + apart), copied[1] });
    }
    Points<2> reversed(points.rbegin(), points.rend());
    const RelaxationReport report = relax(density, points, iterations(3));
    EXPECT_EQ(report.Energy.size(), 4u);
    expectDescent<2>(report, points, density.Size);
    EXPECT_GT(qualityOf<2>(density, points).SmallestSpacing, 0.01);
    EXPECT_EQ(relax(density, reversed, iterations(3)).Energy, report.Energy);
  }
}

// A side that is thinner than the mean spacing: the energy has the same unit.
TEST(Transport, EnergyOfAThinDomain)
{
  const TestDensity<2> density = uniformDensity<2>({ 100, 1 });
  Points<2> points;
  for (int i = 0; i < 10; ++i)
  {
    points.push_back({ 10.0 * i + 5.0, 0.5 });
  }
  // N / A times the mean of (x^2 + y^2) over a cell of sides 10 and `height`.
  for (const double height : { 0.01, 1.0, 40.0 })
  {
    const double expected = 10.0 / (100.0 * height) * (100.0 + height * height) / 12.0;
    const RelaxationReport report =
      relax(density, points, iterations(0), Context(), { 1.0, height });
    EXPECT_NEAR(report.Energy.front(), expected, 1e-9 * expected) << height;
  }
}

// Parts that do not touch, with masses that are no whole numbers of points.
TEST(Transport, PartsApart)
{
  TestDensity<2> density = uniformDensity<2>({ 60, 40 }, 0.0);
  fillBlock(density, { 0, 5 }, { 20, 20 }, 1.0);
  fillBlock(density, { 39, 5 }, { 20, 20 }, 1.3);
  Points<2> points = flowStart<2>(density, 100);
  const RelaxationReport report = relax(density, points, iterations(6));
  EXPECT_GT(report.Energy.size(), 3u);
  expectDescent<2>(report, points, density.Size);
  EXPECT_EQ(qualityOf<2>(density, points).InEmptyCells, 0);
  const auto left = std::count_if(
    points.begin(), points.end(), [](const Point<2>& point) { return point[0] < 30.0; });
  EXPECT_NEAR(static_cast<double>(left), 100.0 / 2.3, 1.0);
}

TEST(Transport, NoIterationsMeasureOnly)
{
  const TestDensity<2> density = twoGaussians<2>({ 30, 20 });
  const Points<2> start = randomPoints<2>(density.Size, 100);
  Points<2> points = start;
  EXPECT_EQ(relax(density, points, iterations(0)).Energy.size(), 1u);
  EXPECT_TRUE(sameBits<2>(points, start));
}

TEST(Transport, ToleranceEndsIt)
{
  const TestDensity<2> density = uniformDensity<2>({ 30, 20 });
  Points<2> points = randomPoints<2>(density.Size, 100);
  const std::vector<double> energy = relax(density, points, iterations(60, 0.02)).Energy;
  ASSERT_GT(energy.size(), 2u);
  EXPECT_LT(energy.size(), 20u);
  for (std::size_t i = 1; i + 1 < energy.size(); ++i)
  {
    EXPECT_LT(energy[i], 0.98 * energy[i - 1]);
  }
  EXPECT_GE(energy.back(), 0.98 * energy[energy.size() - 2]);
}

// Few points, in one place, where nothing is, on the border.
TEST(Transport, AnyStart)
{
  for (const auto& density : { discWithHole<2>({ 20, 20 }), dirac<2>({ 20, 20 }, { 3, 7 }) })
  {
    for (const std::size_t count : { 0, 1, 2, 3, 20 })
    {
      for (const double place : { 0.0, 6.0, 10.0, 25.0 })
      {
        Points<2> points(count, evenPoint<2>(place));
        const RelaxationReport report = relax(density, points, iterations(5));
        expectDescent<2>(report, points, density.Size);
        for (std::size_t i = 0; i < count; ++i)
        {
          EXPECT_EQ(std::count(points.begin(), points.end(), points[i]), 1);
        }
      }
    }
  }
}

TEST(Transport, OnePointGoesToTheCentroid)
{
  const TestDensity<2> density = twoGaussians<2>({ 24, 24 });
  Points<2> points = { { 3.0, 18.0 } };
  relax(density, points, iterations(1));
  const Point<2> centroid = makeFlow(density).Centroid();
  EXPECT_NEAR(points[0][0], centroid[0], 1e-9);
  EXPECT_NEAR(points[0][1], centroid[1], 1e-9);
}

TEST(Transport, WhatIsRefused)
{
  TestDensity<2> density = uniformDensity<2>({ 8, 8 });
  Points<2> points = randomPoints<2>(density.Size, 10);
  const auto run = [&](const RelaxationOptions& options, const Point<2>& spacing) {
    return refusal([&]() { relax(density, points, options, Context(), spacing); });
  };
  EXPECT_EQ(run(iterations(-1), { 1.0, 1.0 }), "MaximumIterations is -1, it must be 0 or more");
  EXPECT_NE(run(iterations(5, 1.0), { 1.0, 1.0 }).find("Tolerance"), std::string::npos);
  EXPECT_NE(run(iterations(5), { 1.0, 0.0 }).find("spacing"), std::string::npos);
  points[4][1] = std::nan("");
  EXPECT_EQ(run(iterations(5), { 1.0, 1.0 }), "point 4 is not finite");
  points[4][1] = 1.0;
  for (const double wrong : { -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    density.Values[5] = wrong;
    EXPECT_THROW(relax(density, points), InvalidDensity);
  }
  density = uniformDensity<2>({ 8, 8 }, 0.0);
  EXPECT_THROW(relax(density, points), InvalidDensity);
}

TEST(Transport, ReportsAndStops)
{
  const TestDensity<2> density = twoGaussians<2>({ 40, 40 });
  const Points<2> start = randomPoints<2>(density.Size, 300);
  const SerialExecutor serial;
  RecordingContext recording(serial);
  Points<2> points = start;
  relax(density, points, iterations(3), recording.Context());
  recording.ExpectReported(0.0, 1.0);
  const int queries = recording.Queries;
  EXPECT_GT(queries, 20);
  for (const int most : { 0, 3, queries / 2 })
  {
    RecordingContext stopped(serial);
    stopped.MaximumQueries = most;
    points = start;
    EXPECT_THROW(relax(density, points, iterations(3), stopped.Context()), Cancelled) << most;
    EXPECT_LE(stopped.Queries, most + 2);
  }
}

} // namespace
} // namespace RectifiedTransport
