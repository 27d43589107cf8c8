// SPDX-License-Identifier: BSD-3-Clause
// Bounds against closed forms, and the map at points.
#include "OptimalMap/TransportLines.h"
#include "TestDensities.h"
#include "ThreadsExecutor.h"

#include "Core/OptimalMap/OptimalMap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

template <int Dimension>
double squareOf(const Point<Dimension>& vector)
{
  double sum = 0.0;
  for (const double v : vector)
  {
    sum += v * v;
  }
  return sum;
}

OptimalMapOptions closeOptions()
{
  OptimalMapOptions options;
  options.Tolerance = 1e-4;
  options.LeastIterations = 0;
  return options;
}

template <int Dimension>
PlacedDensity<Dimension> placed(const TestDensity<Dimension>& density,
  const DensityArray<Dimension, double>& array, const Point<Dimension>& sides)
{
  return { DensitySource<Dimension>(density.Size, array), {}, sides };
}

// The cost is the sum over the axes. The bounds must be on their sides of it, and the lower one not
// far below.
template <int Dimension>
void compareSeparable(std::uint64_t seed, int cases, int most, bool pairs)
{
  RandomLines random(seed);
  int bounded = 0;
  for (int i = 0; i < cases; ++i)
  {
    SCOPED_TRACE("case " + std::to_string(i));
    Point<Dimension> sides;
    std::array<std::vector<double>, Dimension> source;
    std::array<std::vector<double>, Dimension> target;
    double exact = 0.0;
    bool sameSize = true;
    for (std::size_t axis = 0; axis < sides.size(); ++axis)
    {
      sides[axis] = i % 3 == 0 ? 1.0 : 0.2 + 3.0 * random.Uniform();
      const int cells = most / 2 + random.Below(most / 2);
      const int other = pairs && i % 2 == 0 ? most / 2 + random.Below(most / 2) : cells;
      sameSize = sameSize && cells == other;
      source[axis] =
        pairs ? random.Line(other) : std::vector<double>(static_cast<std::size_t>(cells), 1.0);
      target[axis] = random.Line(cells);
      exact += lineCost(source[axis], target[axis], sides[axis]);
    }
    const TestDensity<Dimension> f = SeparableDensity<Dimension>{ source }.Density();
    const TestDensity<Dimension> g = SeparableDensity<Dimension>{ target }.Density();
    const auto from = f.Source();
    const auto to = g.Source();
    OptimalMap<Dimension> map = pairs ? OptimalMap<Dimension>(placed<Dimension>(f, from, sides),
                                          placed<Dimension>(g, to, sides), closeOptions())
                                      : OptimalMap<Dimension>(to, sides, closeOptions());
    map.Solve();
    const double rounding = 1e-12 * squareOf<Dimension>(sides);
    EXPECT_LE(map.LowerBound(), exact + rounding);
    double cell = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double side = sides[axis] / static_cast<double>(std::min(f.Size[axis], g.Size[axis]));
      cell += side * side;
    }
    EXPECT_GE(map.LowerBound(), exact - 0.5 * cell - 0.03 * exact);
    if (sameSize)
    {
      ++bounded;
      EXPECT_GE(map.UpperBound(), exact - rounding);
    }
  }
  EXPECT_GT(bounded, 0);
}

} // namespace

TEST(OptimalMap, BoundsHoldForSeparableDensities1D)
{
  compareSeparable<1>(11, 60, 400, false);
}
TEST(OptimalMap, BoundsHoldForSeparablePairs1D)
{
  compareSeparable<1>(12, 60, 400, true);
}
TEST(OptimalMap, BoundsHoldForSeparableDensities2D)
{
  compareSeparable<2>(13, 40, 96, false);
}
TEST(OptimalMap, BoundsHoldForSeparablePairs2D)
{
  compareSeparable<2>(14, 40, 96, true);
}
TEST(OptimalMap, BoundsHoldForSeparableDensities3D)
{
  compareSeparable<3>(15, 12, 24, false);
}
TEST(OptimalMap, BoundsHoldForSeparablePairs3D)
{
  compareSeparable<3>(16, 12, 24, true);
}

// What bounds do without changes them little.
TEST(OptimalMap, ForBoundsGivesNearlyTheSameBounds)
{
  const TestDensity<2> f = randomCells<2>({ 60, 48 }, 0.1);
  const TestDensity<2> g = twoGaussians<2>({ 60, 48 });
  const auto from = f.Source();
  const auto to = g.Source();
  const Point<2> sides = { 2.0, 1.5 };
  std::array<double, 2> bounds{};
  for (const bool forBounds : { false, true })
  {
    OptimalMapOptions options;
    options.LeastIterations = options.MostIterations = 1;
    options.ForBounds = forBounds;
    OptimalMap<2> map(placed<2>(f, from, sides), placed<2>(g, to, sides), options);
    map.Solve();
    EXPECT_LT(map.LowerBound(), map.UpperBound());
    bounds[forBounds ? 1 : 0] = map.LowerBound();
  }
  EXPECT_NE(bounds[0], bounds[1]); // fewer samples
  EXPECT_NEAR(bounds[1] / bounds[0], 1.0, 0.01);
}

} // namespace RectifiedTransport
