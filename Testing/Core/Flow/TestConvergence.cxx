// SPDX-License-Identifier: BSD-3-Clause
// The error against an independent oracle, and how it falls with the steps.
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace RectifiedTransport
{
namespace
{

// A density, a sample of seeds and where they truly go.
template <int Dimension>
struct Truth
{
  TestDensity<Dimension> Density;
  RectifiedFlow<Dimension> Flow;
  Points<Dimension> Seeds;
  Points<Dimension> Positions;

  Truth(TestDensity<Dimension> density, std::size_t count)
    : Density(std::move(density))
    , Flow(this->Density.Source())
    , Seeds(randomPoints<Dimension>(this->Density.Size, count))
    , Positions(Oracle<Dimension>(this->Density.Values, this->Density.Size).Forward(this->Seeds))
  {
  }

  PositionErrors Errors(const FlowOptions& options) const
  {
    return comparePositions<Dimension>(
      runForward(this->Flow, this->Seeds, options), this->Positions);
  }
};

// The order that two mean errors at n and 2n steps show.
double order(double coarse, double fine)
{
  return std::log2(coarse / fine);
}

template <int Dimension>
void expectConvergence(const Truth<Dimension>& truth, double error32)
{
  for (const FlowMaps maps : OffAndOn)
  {
    const auto error = [&](int count) { return truth.Errors(with(maps, steps(count))).Mean; };
    // The lattices' spacings change in steps, so that the orders vary.
    const double least = maps == FlowMaps::On ? 1.0 : 1.3;
    const double e16 = error(16);
    const double e32 = error(32);
    const double e64 = error(64);
    const double e128 = error(128);
    EXPECT_LT(e32, error32) << nameOf(maps);
    EXPECT_GT(order(e16, e32), least) << nameOf(maps);
    EXPECT_GT(order(e32, e64), least) << nameOf(maps);
    EXPECT_GT(order(e16, e128), 5.0) << nameOf(maps) << " over three doublings";
    EXPECT_GT(order(e128, error(256)), 1.0) << nameOf(maps);
  }
}

TEST(Convergence, Multistep1D)
{
  expectConvergence(Truth<1>(twoGaussians<1>({ 300 }), 400), 0.1);
}

TEST(Convergence, Multistep2D)
{
  expectConvergence(Truth<2>(twoGaussians<2>({ 640, 600 }), 400), 0.12);
}

TEST(Convergence, Multistep3D)
{
  expectConvergence(Truth<3>(twoGaussians<3>({ 40, 33, 36 }), 200), 0.03); // has no maps
}

// Of smooth densities flow maps lessen the error.
template <int Dimension>
void expectMapsHelp(const TestDensity<Dimension>& density, std::initializer_list<int> counts)
{
  const Truth<Dimension> truth(density, 200);
  double before = 1.0;
  for (const int count : counts)
  {
    const double direct = truth.Errors(with(FlowMaps::Off, steps(count))).Mean;
    const double mapped = truth.Errors(with(FlowMaps::On, steps(count))).Mean;
    EXPECT_LT(mapped, 0.9 * direct) << count;
    EXPECT_GT(order(before, mapped), 1.0) << count;
    before = mapped;
  }
}

TEST(Convergence, FlowMaps2D)
{
  expectMapsHelp(twoGaussians<2>({ 640, 600 }), { 16, 32, 64, 128 });
}

// Large enough for flow maps of up to 64 steps.
TEST(Convergence, FlowMaps3D)
{
  expectMapsHelp(twoGaussians<3>({ 140, 151, 143 }), { 16, 32, 64 });
}

// Values that jump from cell to cell.
TEST(Convergence, RandomCells)
{
  expectConvergence(Truth<2>(randomCells<2>({ 300, 400 }), 400), 0.15);
}

// Half of the box empty.
TEST(Convergence, DiscWithHole)
{
  const Truth<2> truth(discWithHole<2>({ 256, 256 }), 400);
  for (const FlowMaps maps : OffAndOn)
  {
    EXPECT_LT(truth.Errors(with(maps, steps(32))).Mean, 0.1) << nameOf(maps);
    EXPECT_LT(truth.Errors(with(maps, steps(64))).Mean, 0.03) << nameOf(maps);
  }
}

// Coarse levels of the tables cost no more than a twentieth of a cell. With few steps boxes of 64
// cells and more use them in the plane, of 128 in space; with 128 steps none does.
TEST(Convergence, CoarseLevels)
{
  const Truth<2> large(twoGaussians<2>({ 700, 530 }), 200);
  const Truth<3> small(twoGaussians<3>({ 70, 110, 83 }), 150);
  const Truth<3> volume(twoGaussians<3>({ 140, 151, 143 }), 100);
  for (const FlowMaps maps : OffAndOn)
  {
    EXPECT_LT(large.Errors(with(maps, steps(32))).Mean, 0.12) << nameOf(maps);
    EXPECT_LT(large.Errors(with(maps, steps(128))).Mean, 0.005) << nameOf(maps);
    EXPECT_LT(small.Errors(with(maps, steps(32))).Mean, 0.05) << nameOf(maps);
    EXPECT_LT(small.Errors(with(maps, steps(128))).Mean, 0.02) << nameOf(maps);
    EXPECT_LT(volume.Errors(with(maps, steps(32))).Mean, 0.045) << nameOf(maps);
  }
}

// Many steps leave no error that the coarse levels would put below them.
TEST(Convergence, ManyStepsOnALargeGrid)
{
  TestDensity<1> noisy = twoGaussians<1>({ 5003 });
  std::mt19937_64 engine(1);
  for (double& value : noisy.Values)
  {
    value *= 0.7 + 0.6 * uniformNumber(engine);
  }
  const Truth<1> line(noisy, 300);
  EXPECT_LT(line.Errors(steps(2048)).Mean, 0.005);
  const Truth<2> large(twoGaussians<2>({ 700, 530 }), 200);
  EXPECT_LT(large.Errors(steps(512)).Mean, 0.002);
}

// With the limit of the velocity at t = 1, RK4 at the published 50 steps loses the 1/(6T) shrink
// toward the centre: 1.2 cells on 1024^2.
TEST(Convergence, RungeKutta4)
{
  const Truth<2> truth(twoGaussians<2>({ 160, 120 }), 400);
  const double e50 = truth.Errors(steps(50, Integrator::RungeKutta4)).Mean;
  const double e200 = truth.Errors(steps(200, Integrator::RungeKutta4)).Mean;
  EXPECT_LT(e50, 0.02);
  EXPECT_GT(order(e50, e200), 2.0) << "over two doublings";
}

TEST(Convergence, Euler)
{
  const Truth<2> truth(twoGaussians<2>({ 160, 120 }), 400);
  const double e64 = truth.Errors(steps(64, Integrator::Euler)).Mean;
  const double e256 = truth.Errors(steps(256, Integrator::Euler)).Mean;
  EXPECT_GT(order(e64, e256), 1.6) << "over two doublings";
}

TEST(Convergence, Adaptive)
{
  const Truth<2> truth(twoGaussians<2>({ 160, 120 }), 400);
  const double rough = truth.Errors(adaptive(0.1)).Mean;
  const double usual = truth.Errors(adaptive(0.01)).Mean;
  const double fine = truth.Errors(adaptive(0.001)).Mean;
  EXPECT_LT(rough, 0.6);
  EXPECT_LT(usual, 0.1);
  EXPECT_LT(fine, 0.015);
  EXPECT_LT(usual, rough / 3.0);
  EXPECT_LT(fine, usual / 3.0);
  const Truth<3> volume(twoGaussians<3>({ 40, 33, 36 }), 200);
  EXPECT_LT(volume.Errors(adaptive(0.01)).Mean, 0.1);
}

// RungeKutta4 is the paper's Algorithm 2 with the correct limit at t = 1, step for step.
template <int Dimension>
void expectTranscription(const TestDensity<Dimension>& density)
{
  Points<Dimension> expected = randomPoints<Dimension>(density.Size, 1000);
  const Points<Dimension> actual =
    runForward(makeFlow(density), expected, steps(50, Integrator::RungeKutta4));
  Paper::advect(
    Paper::buildTables(density.Values, density.Size), expected, 50, Paper::FinalVelocity::Limit);
  EXPECT_LT(largestDistance<Dimension>(actual, expected), 1e-7);
}

TEST(Convergence, RungeKutta4IsThePapersAlgorithm)
{
  expectTranscription<2>(randomCells<2>({ 60, 45 }, 0.2));
  expectTranscription<3>(randomCells<3>({ 20, 26, 31 }, 0.2));
}

// The cost that the documentation states: a velocity a step, four of RK4's; the last step of
// Multistep is in closed form.
TEST(Convergence, Evaluations)
{
  const TestDensity<2> density = twoGaussians<2>({ 64, 48 });
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 1000);
  Points<2> positions(seeds.size());
  const auto evaluations = [&](const FlowOptions& options) {
    return static_cast<double>(flow.Forward(seeds, positions, options).Evaluations) / 1000.0;
  };
  EXPECT_NEAR(evaluations(steps(32)), 31.0, 1.0);
  EXPECT_NEAR(evaluations(steps(64)), 63.0, 1.0);
  EXPECT_NEAR(evaluations(steps(50, Integrator::RungeKutta4)), 200.0, 2.0);
  EXPECT_NEAR(evaluations(steps(50, Integrator::Euler)), 50.0, 1.0);
  EXPECT_LT(evaluations(adaptive(0.03)), 80.0);
  EXPECT_LT(evaluations(adaptive(0.03)), evaluations(adaptive(0.003)));
  // As measured; other orders of the predictor or other estimates take more, or fewer and err more.
  EXPECT_NEAR(evaluations(adaptive(0.03)), 11.4, 0.3);
  EXPECT_NEAR(evaluations(adaptive(0.003)), 22.0, 0.3);
  EXPECT_NEAR(evaluations(adaptive(0.0001)), 67.6, 0.3);
}

} // namespace
} // namespace RectifiedTransport
