// SPDX-License-Identifier: BSD-3-Clause
// Starts and measures of relaxations.
#ifndef RectifiedTransport_TestRelaxation_h
#define RectifiedTransport_TestRelaxation_h

#include "Core/Quality/ParticleQuality.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Seeds/Seeds.h"

#include "TestFlow.h"
#include "TestGrid.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace RectifiedTransport
{

inline RelaxationOptions iterations(int most, double tolerance = 0.0)
{
  RelaxationOptions options;
  options.MaximumIterations = most;
  options.Tolerance = tolerance;
  return options;
}

// Every iteration lowers the energy, and all points are in the domain.
template <int Dimension>
void expectDescent(
  const RelaxationReport& report, const Points<Dimension>& points, const GridSize<Dimension>& size)
{
  for (std::size_t i = 1; i < report.Energy.size(); ++i)
  {
    EXPECT_LT(report.Energy[i], report.Energy[i - 1]) << i;
  }
  for (const auto& point : points)
  {
    EXPECT_TRUE(isInside<Dimension>(point, size));
  }
}

template <int Dimension>
ParticleQuality qualityOf(
  const TestDensity<Dimension>& density, const Points<Dimension>& points, std::int64_t block = 8)
{
  std::vector<Point<3>> placed;
  for (const auto& point : points)
  {
    placed.push_back({});
    std::copy(point.begin(), point.end(), placed.back().begin());
  }
  const RectifiedFlow<Dimension> flow(density.Source());
  return measureQuality<Dimension>(
    { placed }, flow, makeGrid<Dimension>(density.Size, { 1.0, 1.0, 1.0 }), block);
}

// E of the paper: the mean squared distance to the nearest point, in units of area / points.
inline double quantisation(const TestDensity<2>& density, const Points<2>& points)
{
  double sum = 0.0;
  double mass = 0.0;
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    const auto cell = cellAt<2>(static_cast<std::int64_t>(i), density.Size);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point<2>& point : points)
    {
      const double x = point[0] - static_cast<double>(cell[0]) - 0.5;
      const double y = point[1] - static_cast<double>(cell[1]) - 0.5;
      nearest = std::min(nearest, x * x + y * y);
    }
    sum += density.Values[i] * nearest;
    mass += density.Values[i];
  }
  return sum / mass * static_cast<double>(points.size()) /
    static_cast<double>(density.Values.size());
}

template <int Dimension>
Points<Dimension> flowStart(const TestDensity<Dimension>& density, std::size_t count)
{
  Points<Dimension> points(count);
  Point<Dimension> lengths;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    lengths[axis] = static_cast<double>(density.Size[axis]);
  }
  generateSeeds<Dimension>(SeedPattern::BlueNoise, lengths, 1, points);
  for (auto& point : points)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      point[axis] *= lengths[axis];
    }
  }
  return runForward<Dimension>(makeFlow(density), points);
}

// For relax(density, points, options, context), which returns a RelaxationReport.
template <class Relax>
void expectSameBitsOnAnyThreads(const Relax& relax, int most)
{
  const TestDensity<2> density = twoGaussians<2>({ 50, 60 });
  const Points<2> start = randomPoints<2>(density.Size, 700);
  Points<2> one = start;
  const RelaxationReport report = relax(density, one, iterations(most), ThreadsExecutor(1));
  for (const int threads : { 2, 3 })
  {
    Points<2> many = start;
    EXPECT_EQ(
      relax(density, many, iterations(most), ThreadsExecutor(threads)).Energy, report.Energy);
    EXPECT_TRUE(sameBits<2>(one, many)) << threads;
  }
}

template <class Relax>
void expectAnyOrder(const Relax& relax, int most)
{
  const TestDensity<2> density = twoGaussians<2>({ 50, 60 });
  Points<2> points = randomPoints<2>(density.Size, 300);
  Points<2> reversed(points.rbegin(), points.rend());
  EXPECT_EQ(relax(density, points, iterations(most), Context()).Energy,
    relax(density, reversed, iterations(most), Context()).Energy);
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_TRUE(sameBits<2>(points, reversed));
}

} // namespace RectifiedTransport

#endif
