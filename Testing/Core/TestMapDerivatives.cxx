// SPDX-License-Identifier: BSD-3-Clause
// Divergence and Jacobian determinant of maps on a lattice: of maps that are known, and of the
// flow, which has to turn one measure into the other.
#include "MapDerivatives.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace RectifiedTransport
{
namespace
{

struct Derivatives
{
  std::vector<double> Divergence;
  std::vector<double> Determinant;
};

// Of the map that takes sample i to positions[i], in ranges that the samples' rows do not fit.
template <int Dimension>
Derivatives derive(const GridSize<Dimension>& lattice, const GridSize<Dimension>& size,
  const NotDeduced<Points<Dimension>>& positions)
{
  Point<Dimension> step;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    step[axis] = static_cast<double>(size[axis]) / static_cast<double>(lattice[axis]);
  }
  const MapDerivatives<Dimension> map(lattice, step, positions.data()->data());
  Derivatives found{ std::vector<double>(positions.size()), std::vector<double>(positions.size()) };
  OpenMPExecutor().For(
    static_cast<std::int64_t>(positions.size()), 7, [&](std::int64_t first, std::int64_t last) {
      map.Write(first, last, found.Divergence.data(), found.Determinant.data());
    });
  return found;
}

template <int Dimension, class Map>
Derivatives deriveMap(
  const GridSize<Dimension>& lattice, const GridSize<Dimension>& size, const Map& map)
{
  Points<Dimension> positions = latticePoints<Dimension>(size, lattice);
  for (Point<Dimension>& point : positions)
  {
    point = map(point);
  }
  return derive<Dimension>(lattice, size, positions);
}

TEST(MapDerivatives, LinearMaps)
{
  const Derivatives line =
    deriveMap<1>({ 30 }, { 20 }, [](const Point<1>& x) { return Point<1>{ 2.5 * x[0] - 1.0 }; });
  const Derivatives plane = deriveMap<2>({ 9, 14 }, { 12, 7 }, [](const Point<2>& x) {
    return Point<2>{ 0.5 * x[0] + 0.25 * x[1] + 3.0, -2.0 * x[0] + 1.5 * x[1] };
  });
  const Derivatives space = deriveMap<3>({ 5, 6, 4 }, { 5, 3, 8 }, [](const Point<3>& x) {
    return Point<3>{ 2.0 * x[0] + x[1] - x[2], x[1] + 3.0 * x[2], -x[0] + 0.5 * x[2] };
  });
  for (std::size_t i = 0; i < line.Divergence.size(); ++i)
  {
    ASSERT_NEAR(line.Divergence[i], 1.5, 1e-13);
    ASSERT_NEAR(line.Determinant[i], 2.5, 1e-13);
  }
  for (std::size_t i = 0; i < plane.Divergence.size(); ++i)
  {
    ASSERT_NEAR(plane.Divergence[i], 0.0, 1e-13);
    ASSERT_NEAR(plane.Determinant[i], 0.75 + 0.5, 1e-13);
  }
  for (std::size_t i = 0; i < space.Divergence.size(); ++i)
  {
    ASSERT_NEAR(space.Divergence[i], 0.5, 1e-13);
    ASSERT_NEAR(space.Determinant[i], 2.0 * 0.5 - 1.0 * (0.0 + 3.0) - 1.0 * (0.0 + 1.0), 1e-13);
  }
}

// Central differences are exact for squares, one-sided ones are half a step off.
TEST(MapDerivatives, Border)
{
  const double step = 20.0 / 8.0;
  const Derivatives found =
    deriveMap<1>({ 8 }, { 20 }, [](const Point<1>& x) { return Point<1>{ x[0] * x[0] }; });
  for (int i = 0; i < 8; ++i)
  {
    const double x = (i + 0.5) * step + (i == 0 ? 0.5 * step : i == 7 ? -0.5 * step : 0.0);
    ASSERT_NEAR(found.Determinant[i], 2.0 * x, 1e-12);
    ASSERT_NEAR(found.Divergence[i], 2.0 * x - 1.0, 1e-12);
  }
}

// Along an axis of one sample the displacement is constant.
TEST(MapDerivatives, AxisOfOneSample)
{
  const Derivatives found = deriveMap<2>({ 6, 1 }, { 6, 5 }, [](const Point<2>& x) {
    return Point<2>{ 3.0 * x[0], 7.0 * x[1] };
  });
  for (std::size_t i = 0; i < found.Divergence.size(); ++i)
  {
    ASSERT_NEAR(found.Divergence[i], 2.0, 1e-13);
    ASSERT_NEAR(found.Determinant[i], 3.0, 1e-13);
  }
}

double bump(double x, double centre, double width)
{
  return std::exp(-(x - centre) * (x - centre) / (width * width));
}

template <int Dimension>
double smooth(const Point<Dimension>& p)
{
  double product = 1.0;
  double sum = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    product *= bump(p[axis], 0.35 + 0.1 * axis, 0.3);
    sum += std::cos(3.0 * p[axis] + axis);
  }
  return 0.6 + 2.0 * product + 0.1 * sum;
}

// The relative spread of det J f(T(x)), which has to be the mean of f everywhere; backward of
// f(x) / det J.
template <int Dimension>
double spread(std::int64_t side, bool backward)
{
  GridSize<Dimension> size;
  size.fill(side);
  const TestDensity<Dimension> density = sampleDensity<Dimension>(size, smooth<Dimension>);
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> samples = latticePoints<Dimension>(size, size);
  Points<Dimension> positions(samples.size());
  double* to = positions.data()->data();
  if (backward)
  {
    flow.BackwardLattice(size, to, adaptive(0.0001));
  }
  else
  {
    flow.ForwardLattice(size, to, adaptive(0.0001));
  }
  const Derivatives found = derive<Dimension>(size, size, positions);
  const auto count = static_cast<double>(samples.size());
  const double mean = flow.Total() / count;
  double squares = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    Point<Dimension> p = backward ? samples[i] : positions[i];
    for (double& coordinate : p)
    {
      coordinate /= static_cast<double>(side);
    }
    const double f = smooth<Dimension>(p);
    const double part = (backward ? f / found.Determinant[i] : f * found.Determinant[i]) / mean;
    squares += (part - 1.0) * (part - 1.0);
  }
  return std::sqrt(squares / count);
}

template <int Dimension>
void expectMeasure(std::int64_t side, double coarse)
{
  for (const bool backward : { false, true })
  {
    const double first = spread<Dimension>(side, backward);
    const double second = spread<Dimension>(2 * side, backward);
    EXPECT_LT(first, coarse) << (backward ? "backward" : "forward");
    EXPECT_LT(second, 0.6 * first) << (backward ? "backward" : "forward");
  }
}

TEST(MapDerivatives, TurnOneMeasureIntoTheOther)
{
  expectMeasure<1>(100, 0.05);
  expectMeasure<2>(48, 0.05);
  expectMeasure<3>(16, 0.1);
}

} // namespace
} // namespace RectifiedTransport
