// SPDX-License-Identifier: BSD-3-Clause
// Gaussian blue noise: what it does to points, and for which inputs.
#include "Core/Relaxation/BlueNoiseRelaxation.h"

#include "RecordingContext.h"
#include "TestRefusal.h"
#include "TestRelaxation.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
RelaxationReport relax(const TestDensity<Dimension>& density, Points<Dimension>& points,
  const RelaxationOptions& options = {}, const Context& context = Context(),
  const Point<Dimension>& spacing = evenPoint<Dimension>(1.0))
{
  const RectifiedFlow<Dimension> flow(density.Source());
  return relaxByRepulsion<Dimension>(density.Source(), flow, spacing, points, options, context);
}

const auto relaxIn = [](const TestDensity<2>& density, Points<2>& points,
                       const RelaxationOptions& options, const Context& context) {
  return relax<2>(density, points, options, context);
};

// Independent points have the energy 1; then they spread evenly up to the border.
TEST(Repulsion, RandomPointsBecomeBlueNoise)
{
  const TestDensity<2> density = uniformDensity<2>({ 64, 64 });
  Points<2> points = randomPoints<2>(density.Size, 1024);
  const RelaxationReport report = relax<2>(density, points, iterations(60));
  EXPECT_NEAR(report.Energy.front(), 1.0, 0.1);
  EXPECT_LT(report.Energy.back(), 0.005);
  expectDescent<2>(report, points, density.Size);
  const ParticleQuality quality = qualityOf<2>(density, points);
  EXPECT_GT(quality.MeanSpacing, 0.88);
  EXPECT_GT(quality.SmallestSpacing, 0.65);
  // A strip of two mean spacings along the border.
  const auto strip = std::count_if(points.begin(), points.end(), [](const Point<2>& p) {
    return std::min({ p[0], p[1], 64.0 - p[0], 64.0 - p[1] }) < 4.0;
  });
  EXPECT_NEAR(static_cast<double>(strip) / (1024.0 - 28.0 * 28.0), 0.95, 0.1);
}

TEST(Repulsion, InSpace)
{
  const TestDensity<3> density = uniformDensity<3>(evenSize<3>(16));
  Points<3> points = randomPoints<3>(density.Size, 300);
  const RelaxationReport report = relax<3>(density, points, iterations(40));
  EXPECT_NEAR(report.Energy.front(), 1.0, 0.2);
  EXPECT_LT(report.Energy.back(), 0.02);
  expectDescent<3>(report, points, density.Size);
  EXPECT_GT(qualityOf<3>(density, points).MeanSpacing, 0.86);
}

TEST(Repulsion, ImprovesWhatTheFlowMakes)
{
  const TestDensity<2> density = twoGaussians<2>({ 96, 80 });
  Points<2> points = flowStart<2>(density, 600);
  const ParticleQuality before = qualityOf<2>(density, points, 12);
  const double energyBefore = quantisation(density, points);
  const RelaxationReport report = relax<2>(density, points, iterations(50));
  expectDescent<2>(report, points, density.Size);
  const ParticleQuality after = qualityOf<2>(density, points, 12);
  EXPECT_LT(quantisation(density, points), 0.98 * energyBefore);
  EXPECT_GT(after.MeanSpacing, before.MeanSpacing);
  EXPECT_GT(after.SmallestSpacing, before.SmallestSpacing);
  EXPECT_LT(after.DensityError, 1.1 * before.DensityError);
}

// Where no points belong, none stay.
TEST(Repulsion, LeavesHoles)
{
  const TestDensity<2> density = discWithHole<2>({ 64, 64 });
  Points<2> points = randomPoints<2>(density.Size, 400);
  const ParticleQuality before = qualityOf<2>(density, points);
  expectDescent<2>(relax<2>(density, points, iterations(80)), points, density.Size);
  const ParticleQuality after = qualityOf<2>(density, points);
  EXPECT_GT(before.InEmptyCells, 150);
  EXPECT_LT(after.InEmptyCells, 20);
  EXPECT_LT(after.DensityError, 0.5 * before.DensityError);
}

TEST(Repulsion, SameBitsOnAnyThreads)
{
  expectSameBitsOnAnyThreads(relaxIn, 12);
}

// Nor does the order of the points change a bit.
TEST(Repulsion, FollowsTheOrderOfThePoints)
{
  expectAnyOrder(relaxIn, 20);
}

// Cells of another shape, the same density in space.
TEST(Repulsion, SeesPhysicalSpace)
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
    relax<2>(coarse, first, iterations(5), Context(), Point<2>{ 0.3, 0.6 });
  const RelaxationReport other = relax<2>(fine, second, iterations(5));
  ASSERT_EQ(report.Energy.size(), other.Energy.size());
  EXPECT_NEAR(report.Energy.back(), other.Energy.back(), 1e-5);
  for (Point<2>& point : second)
  {
    point[1] *= 0.5;
  }
  EXPECT_LT(largestDistance<2>(first, second), 1e-4);
}

TEST(Repulsion, NoIterationsMeasureOnly)
{
  const TestDensity<2> density = twoGaussians<2>({ 30, 20 });
  const Points<2> start = randomPoints<2>(density.Size, 100);
  Points<2> points = start;
  EXPECT_EQ(relax<2>(density, points, iterations(0)).Energy.size(), 1u);
  EXPECT_TRUE(sameBits<2>(points, start));
  points[3] = { -5.0, 1e300 };
  points[7] = points[8];
  relax<2>(density, points, iterations(0));
  EXPECT_EQ(points[3], (Point<2>{ 0.0, 20.0 }));
  EXPECT_NE(points[7], points[8]);
  EXPECT_TRUE(points[7] == start[8] || points[8] == start[8]);
  points[3] = start[3];
  points[7] = start[7];
  points[8] = start[8];
  EXPECT_TRUE(sameBits<2>(points, start));
}

// Also after points have gone to other leaves and have got other neighbours.
TEST(Repulsion, TheLastEnergyIsThatOfThePoints)
{
  const TestDensity<2> density = twoGaussians<2>({ 60, 50 });
  for (const int most : { 5, 40 })
  {
    Points<2> points = randomPoints<2>(density.Size, 700);
    const double last = relax<2>(density, points, iterations(most)).Energy.back();
    EXPECT_NEAR(relax<2>(density, points, iterations(0)).Energy.front() / last, 1.0, 1e-9);
  }
}

TEST(Repulsion, ToleranceEndsIt)
{
  const TestDensity<2> density = uniformDensity<2>({ 30, 20 });
  Points<2> points = randomPoints<2>(density.Size, 100);
  const std::vector<double> energy = relax<2>(density, points, iterations(60, 0.2)).Energy;
  ASSERT_GT(energy.size(), 2u);
  EXPECT_LT(energy.size(), 60u);
  for (std::size_t i = 1; i + 1 < energy.size(); ++i)
  {
    EXPECT_LT(energy[i], 0.8 * energy[i - 1]);
  }
  EXPECT_GE(energy.back(), 0.8 * energy[energy.size() - 2]);
}

// Few points, in one place, where nothing is, on the border.
template <int Dimension>
void expectAnyStart(const TestDensity<Dimension>& density)
{
  for (const std::size_t count : { 0, 1, 2, 3, 50 })
  {
    const auto size = static_cast<double>(density.Size[0]);
    for (const double place : { 0.0, 0.3 * size, 0.5 * size, size })
    {
      Points<Dimension> points(count, evenPoint<Dimension>(place));
      const RelaxationReport report = relax<Dimension>(density, points, iterations(15));
      expectDescent<Dimension>(report, points, density.Size);
      for (std::size_t i = 0; i < count; ++i)
      {
        EXPECT_EQ(std::count(points.begin(), points.end(), points[i]), 1);
      }
    }
  }
}

TEST(Repulsion, AnyStart)
{
  expectAnyStart<2>(discWithHole<2>({ 20, 20 }));
  expectAnyStart<2>(dirac<2>({ 20, 20 }, { 3, 7 }));
  expectAnyStart<3>(discWithHole<3>({ 8, 8, 8 }));
}

// One point for all the mass goes to where its Gaussian covers most of it.
TEST(Repulsion, OnePointGoesToTheMiddle)
{
  const TestDensity<2> density = uniformDensity<2>({ 20, 20 });
  Points<2> points = { { 3.0, 18.0 } };
  relax<2>(density, points, iterations(100));
  EXPECT_NEAR(points[0][0], 10.0, 0.01);
  EXPECT_NEAR(points[0][1], 10.0, 0.01);
}

TEST(Repulsion, ThinDomains)
{
  const TestDensity<2> density = uniformDensity<2>({ 1, 200 });
  Points<2> points = randomPoints<2>(density.Size, 40);
  expectDescent<2>(relax<2>(density, points, iterations(200)), points, density.Size);
  std::sort(
    points.begin(), points.end(), [](const Point<2>& a, const Point<2>& b) { return a[1] < b[1]; });
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    EXPECT_NEAR(points[i][1] - points[i - 1][1], 5.0, 1.5) << i;
  }
}

TEST(Repulsion, WhatIsRefused)
{
  const TestDensity<2> density = uniformDensity<2>({ 8, 8 });
  Points<2> points = randomPoints<2>(density.Size, 10);
  const auto run = [&](const RelaxationOptions& options, const Point<2>& spacing) {
    return refusal([&]() { relax<2>(density, points, options, Context(), spacing); });
  };
  EXPECT_EQ(run(iterations(-1), { 1.0, 1.0 }), "MaximumIterations is -1, it must be 0 or more");
  for (const double tolerance : { -0.1, 1.0, std::nan("") })
  {
    EXPECT_NE(run(iterations(5, tolerance), { 1.0, 1.0 }).find("Tolerance"), std::string::npos);
  }
  for (const double side : { 0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    EXPECT_NE(run(iterations(5), { 1.0, side }).find("spacing"), std::string::npos);
  }
  points[4][1] = std::nan("");
  EXPECT_EQ(run(iterations(5), { 1.0, 1.0 }), "point 4 is not finite");
  const RectifiedFlow<2> other(uniformDensity<2>({ 9, 8 }).Source());
  EXPECT_THROW(
    relaxByRepulsion<2>(density.Source(), other, { 1.0, 1.0 }, points), std::invalid_argument);
}

TEST(Repulsion, ReportsAndStops)
{
  const TestDensity<2> density = twoGaussians<2>({ 40, 40 });
  const Points<2> start = randomPoints<2>(density.Size, 300);
  const SerialExecutor serial;
  RecordingContext recording(serial);
  Points<2> points = start;
  relax<2>(density, points, iterations(8), recording.Context());
  recording.ExpectReported(0.0, 1.0);
  const int queries = recording.Queries;
  EXPECT_GT(queries, 20);
  for (const int most : { 0, 3, queries / 2, queries - 1 })
  {
    RecordingContext stopped(serial);
    stopped.MaximumQueries = most;
    points = start;
    const RectifiedFlow<2> flow(density.Source());
    EXPECT_THROW(relaxByRepulsion<2>(
                   density.Source(), flow, { 1.0, 1.0 }, points, iterations(8), stopped.Context()),
      Cancelled)
      << most;
    EXPECT_LE(stopped.Queries, most + 2);
  }
}

} // namespace
} // namespace RectifiedTransport
