// SPDX-License-Identifier: BSD-3-Clause
// Divergence and Jacobian determinant of maps on a lattice: of maps that are known, and of the
// flow, which has to turn one measure into the other.
#include "Core/Flow/MapDerivatives.h"
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
  const MapDerivatives<Dimension> map(lattice, step, positions);
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

// det J f(T(x)), backward f(x) / det J, over the mean of f: 1 everywhere, were there no errors.
template <int Dimension>
std::vector<double> measureRatios(std::int64_t side, bool backward)
{
  const auto size = evenSize<Dimension>(side);
  const TestDensity<Dimension> density = sampleDensity<Dimension>(size, smooth<Dimension>);
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> samples = latticePoints<Dimension>(size, size);
  Points<Dimension> positions(samples.size());
  if (backward)
  {
    flow.Backward(FlowSeeds<Dimension>::Lattice(size), positions, adaptive(0.0001));
  }
  else
  {
    flow.Forward(FlowSeeds<Dimension>::Lattice(size), positions, adaptive(0.0001));
  }
  const Derivatives found = derive<Dimension>(size, size, positions);
  const double mean = flow.Total() / static_cast<double>(samples.size());
  std::vector<double> ratios(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    Point<Dimension> p = backward ? samples[i] : positions[i];
    for (double& coordinate : p)
    {
      coordinate /= static_cast<double>(side);
    }
    const double f = smooth<Dimension>(p);
    ratios[i] = (backward ? f / found.Determinant[i] : f * found.Determinant[i]) / mean;
  }
  return ratios;
}

// Their relative spread.
template <int Dimension>
double spread(std::int64_t side, bool backward)
{
  const std::vector<double> ratios = measureRatios<Dimension>(side, backward);
  double squares = 0.0;
  for (const double ratio : ratios)
  {
    squares += (ratio - 1.0) * (ratio - 1.0);
  }
  return std::sqrt(squares / static_cast<double>(ratios.size()));
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

// Near a corner the map scales, but the diagonal does not go where the sum of the sides goes: the
// corner has no derivative, and no stencil finds one.
TEST(MapDerivatives, CornersScaleAndHaveNone)
{
  const GridSize<2> size{ 512, 512 };
  const RectifiedFlow<2> flow = makeFlow(sampleDensity<2>(size, smooth<2>));
  for (const bool backward : { false, true })
  {
    const auto at = [&](double scale) {
      const Points<2> rays{ { scale, 0.0 }, { 0.0, scale }, { scale, scale } };
      Points<2> found = backward ? runBackward<2>(flow, rays, adaptive(1e-6))
                                 : runForward<2>(flow, rays, adaptive(1e-6));
      for (Point<2>& point : found)
      {
        point = { point[0] / scale, point[1] / scale };
      }
      return found;
    };
    const Points<2> small = at(1.0);
    const Points<2> large = at(4.0);
    for (std::size_t ray = 0; ray < small.size(); ++ray)
    {
      EXPECT_NEAR(small[ray][0], large[ray][0], 0.003);
      EXPECT_NEAR(small[ray][1], large[ray][1], 0.003);
    }
    const double x = small[2][0] / (small[0][0] + small[1][0]);
    const double y = small[2][1] / (small[0][1] + small[1][1]);
    EXPECT_GT(std::max(std::abs(x - 1.0), std::abs(y - 1.0)), 0.1);
  }
}

// What is lost there: it stays as it is with more samples, in the corners alone.
TEST(MapDerivatives, Corners)
{
  for (const bool backward : { false, true })
  {
    for (const std::int64_t side : { 48, 96 })
    {
      const std::vector<double> ratios = measureRatios<2>(side, backward);
      const auto off = [&](std::int64_t i) {
        return std::abs(ratios[static_cast<std::size_t>(i * side + i)] - 1.0);
      };
      EXPECT_LT(std::max(off(0), off(side - 1)), 0.25);
      EXPECT_LT(std::max(off(1), off(side - 2)), 0.035);
    }
  }
}

} // namespace
} // namespace RectifiedTransport
