// SPDX-License-Identifier: BSD-3-Clause
// Densities whose transport is known exactly.
#include "TestFlow.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
PositionErrors forwardErrors(
  const SeparableDensity<Dimension>& separable, const FlowOptions& options)
{
  const TestDensity<Dimension> density = separable.Density();
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, 2000);
  Points<Dimension> truth(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    truth[i] = separable.Forward(seeds[i]);
  }
  return comparePositions<Dimension>(runForward(makeFlow(density), seeds, options), truth);
}

template <int Dimension>
SeparableDensity<Dimension> uniformFactors(const GridSize<Dimension>& size)
{
  return randomSeparable<Dimension>(size, 1.0);
}

// The identity up to the integrator's error, which must fall with the number of steps.
template <int Dimension>
void expectUniformIsIdentity(const GridSize<Dimension>& size, double error16)
{
  const SeparableDensity<Dimension> uniform = uniformFactors<Dimension>(size);
  for (const Integrator method : { Integrator::Multistep, Integrator::RungeKutta4 })
  {
    const double coarse = forwardErrors(uniform, steps(16, method)).Mean;
    const double middle = forwardErrors(uniform, steps(32, method)).Mean;
    const double fine = forwardErrors(uniform, steps(64, method)).Mean;
    EXPECT_LT(coarse, error16) << nameOf(method);
    EXPECT_LT(middle, coarse / 2.5) << nameOf(method);
    EXPECT_LT(fine, middle / 2.5) << nameOf(method);
  }
  const double euler = forwardErrors(uniform, steps(64, Integrator::Euler)).Mean;
  EXPECT_LT(forwardErrors(uniform, steps(128, Integrator::Euler)).Mean, euler / 1.6);
  EXPECT_LT(forwardErrors(uniform, adaptive(0.001)).Mean, 0.01);
}

TEST(Analytic, UniformDensityIsTheIdentity1D)
{
  expectUniformIsIdentity<1>({ 37 }, 0.05);
}

TEST(Analytic, UniformDensityIsTheIdentity2D)
{
  expectUniformIsIdentity<2>({ 40, 23 }, 0.05);
}

TEST(Analytic, UniformDensityIsTheIdentity3D)
{
  expectUniformIsIdentity<3>({ 18, 9, 14 }, 0.05);
}

// Axis by axis the inverse of the cumulative sum.
template <int Dimension>
void expectSeparable(const SeparableDensity<Dimension>& separable, double error32)
{
  const double coarse = forwardErrors(separable, steps(32)).Mean;
  const double fine = forwardErrors(separable, steps(128)).Mean;
  EXPECT_LT(coarse, error32);
  EXPECT_LT(fine, coarse / 4.0);
  EXPECT_LT(forwardErrors(separable, steps(200, Integrator::RungeKutta4)).Mean, error32);
  EXPECT_LT(forwardErrors(separable, steps(1000, Integrator::Euler)).Mean, 10.0 * error32);
  EXPECT_LT(forwardErrors(separable, adaptive(0.001)).Mean, 0.5 * error32);
}

TEST(Analytic, SeparableDensity1D)
{
  expectSeparable(randomSeparable<1>({ 150 }, 0.05), 0.1);
}

TEST(Analytic, SeparableDensity2D)
{
  expectSeparable(randomSeparable<2>({ 70, 45 }, 0.05), 0.05);
}

TEST(Analytic, SeparableDensity3D)
{
  expectSeparable(randomSeparable<3>({ 24, 31, 19 }, 0.05), 0.05);
}

// Large enough for coarse levels of tables, with sides that their spacing does not divide, and so
// few steps that they are used.
TEST(Analytic, SeparableDensityOnCoarseLevels)
{
  EXPECT_LT(forwardErrors(randomSeparable<1>({ 5003 }, 0.05), steps(512)).Mean, 0.1);
  EXPECT_LT(forwardErrors(randomSeparable<1>({ 5003 }, 0.05), steps(40)).Mean, 0.8);
  EXPECT_LT(forwardErrors(randomSeparable<2>({ 517, 263 }, 0.05), steps(128)).Mean, 0.1);
  EXPECT_LT(forwardErrors(randomSeparable<2>({ 517, 263 }, 0.05), steps(32)).Mean, 0.35);
  EXPECT_LT(forwardErrors(randomSeparable<3>({ 131, 142, 150 }, 0.05), steps(32)).Mean, 0.2);
  // Where the integrator's own error is small, a wrong level shows.
  EXPECT_LT(forwardErrors(uniformFactors<2>({ 517, 263 }), steps(40)).Mean, 0.06);
  EXPECT_LT(forwardErrors(uniformFactors<3>({ 131, 142, 150 }), steps(40)).Mean, 0.035);
}

// A half-plane three times as dense as the other: 1/8 of the box moves to each quarter of the
// thin half.
TEST(Analytic, TwoHalfPlanes)
{
  SeparableDensity<2> halves = uniformFactors<2>({ 32, 8 });
  std::fill(halves.Factors[0].begin() + 16, halves.Factors[0].end(), 3.0);
  const Point<2> seed{ 4.0, 3.0 };
  EXPECT_DOUBLE_EQ(halves.Forward(seed)[0], 8.0);
  EXPECT_DOUBLE_EQ(halves.Forward({ 8.0, 3.0 })[0], 16.0);
  EXPECT_LT(forwardErrors(halves, steps(32)).Mean, 0.02);
  EXPECT_LT(forwardErrors(halves, steps(256)).Mean, 2e-4);
}

// One half-plane empty: the box is squeezed into the other.
TEST(Analytic, EmptyHalfPlane)
{
  SeparableDensity<2> halves = uniformFactors<2>({ 32, 24 });
  std::fill(halves.Factors[0].begin(), halves.Factors[0].begin() + 16, 0.0);
  EXPECT_LT(forwardErrors(halves, steps(32)).Mean, 0.05);
  EXPECT_LT(forwardErrors(halves, steps(256)).Mean, 1e-3);
}

// One cell holds all: the box is shrunk into it.
template <int Dimension>
void expectDirac(const GridSize<Dimension>& size, const GridSize<Dimension>& cell)
{
  SeparableDensity<Dimension> spike;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    spike.Factors[axis].assign(size[axis], 0.0);
    spike.Factors[axis][cell[axis]] = 1.0;
  }
  for (const Integrator method : AllIntegrators)
  {
    FlowOptions options = steps(64, method);
    options.Tolerance = 0.001;
    EXPECT_LT(forwardErrors(spike, options).Mean, method == Integrator::Euler ? 0.1 : 0.01)
      << nameOf(method);
  }
}

TEST(Analytic, Dirac)
{
  expectDirac<1>({ 60 }, { 41 });
  expectDirac<2>({ 48, 33 }, { 5, 20 });
  expectDirac<3>({ 17, 20, 13 }, { 8, 0, 12 });
}

} // namespace
} // namespace RectifiedTransport
