// SPDX-License-Identifier: BSD-3-Clause
// The inverse map, against exact solutions and against the oracle run backward. A round trip alone
// would prove little: a bias that both directions share cancels in it.
#include "TestFlow.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
void expectSeparable(const GridSize<Dimension>& size, double error32)
{
  const SeparableDensity<Dimension> separable = randomSeparable<Dimension>(size, 0.05);
  const RectifiedFlow<Dimension> flow = makeFlow(separable.Density());
  const Points<Dimension> seeds = randomPoints<Dimension>(size, 1000);
  Points<Dimension> points = seeds;
  for (Point<Dimension>& point : points)
  {
    point = separable.Forward(point);
  }
  const auto error = [&](const FlowOptions& options) {
    return comparePositions<Dimension>(runBackward(flow, points, options), seeds).Mean;
  };
  const double coarse = error(steps(32));
  EXPECT_LT(coarse, error32);
  EXPECT_LT(error(steps(128)), coarse / 4.0);
  EXPECT_LT(error(steps(200, Integrator::RungeKutta4)), error32);
  EXPECT_LT(error(steps(1000, Integrator::Euler)), 10.0 * error32);
  EXPECT_LT(error(adaptive(0.001)), error32);
}

TEST(Backward, SeparableDensity)
{
  expectSeparable<1>({ 150 }, 0.3);
  expectSeparable<2>({ 70, 45 }, 0.2);
  expectSeparable<3>({ 24, 31, 19 }, 0.1);
}

template <int Dimension>
void expectOracle(const TestDensity<Dimension>& density, std::size_t count, double error32)
{
  // Points that are spread like the density, as those are that a user inverts.
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> points =
    runForward(flow, randomPoints<Dimension>(density.Size, count), steps(128));
  const Points<Dimension> truth = Oracle<Dimension>(density.Values, density.Size).Backward(points);
  const auto error = [&](const FlowOptions& options) {
    return comparePositions<Dimension>(runBackward(flow, points, options), truth).Mean;
  };
  const double coarse = error(steps(32));
  EXPECT_LT(coarse, error32);
  EXPECT_LT(error(steps(128)), coarse / 4.0);
  EXPECT_LT(error(steps(200, Integrator::RungeKutta4)), 0.5 * error32);
  EXPECT_LT(error(adaptive(0.003)), 0.5 * error32);
}

TEST(Backward, Oracle)
{
  expectOracle<1>(twoGaussians<1>({ 300 }), 300, 0.3);
  expectOracle<2>(twoGaussians<2>({ 160, 120 }), 300, 0.3);
  expectOracle<2>(randomCells<2>({ 90, 120 }), 300, 0.3);
  expectOracle<3>(twoGaussians<3>({ 40, 33, 36 }), 150, 0.1);
}

TEST(Backward, OracleWithVoids)
{
  expectOracle<2>(discWithHole<2>({ 128, 128 }), 300, 0.3);
  expectOracle<3>(discWithHole<3>({ 32, 32, 32 }), 150, 0.1);
}

// A point in an empty region keeps its place in the box until the box has mass. Its velocity jumps
// then, so that the order is one.
TEST(Backward, PointsInEmptyRegions)
{
  const TestDensity<2> density = discWithHole<2>({ 128, 128 });
  Points<2> points;
  for (const Point<2>& point : randomPoints<2>(density.Size, 600))
  {
    if (density.Values[cellIndex<2>(cellOf<2>(point, density.Size), density.Size)] == 0.0)
    {
      points.push_back(point);
    }
  }
  const Points<2> truth = Oracle<2>(density.Values, density.Size).Backward(points);
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> coarse = runBackward(flow, points, steps(32));
  EXPECT_EQ(Strays<2>(coarse, uniformDensity<2>(density.Size)).Outside, 0);
  EXPECT_LT(comparePositions<2>(coarse, truth).Mean, 12.0);
  EXPECT_LT(comparePositions<2>(runBackward(flow, points, steps(512)), truth).Mean, 0.6);
}

// The two directions undo each other up to the integrator's error.
TEST(Backward, RoundTrip)
{
  const TestDensity<2> density = twoGaussians<2>({ 160, 120 });
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 1000);
  for (const Integrator method :
    { Integrator::Multistep, Integrator::RungeKutta4, Integrator::Adaptive })
  {
    FlowOptions options = steps(256, method);
    options.Tolerance = 0.001;
    const Points<2> points = runForward(flow, seeds, options);
    EXPECT_LT(comparePositions<2>(runBackward(flow, points, options), seeds).Mean, 0.02)
      << nameOf(method);
  }
}

} // namespace
} // namespace RectifiedTransport
