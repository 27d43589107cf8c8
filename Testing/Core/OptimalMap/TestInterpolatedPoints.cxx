// SPDX-License-Identifier: BSD-3-Clause
// The optimal map with interpolated points: near the optimum, on mass, undone by the way back,
// smooth, the same bits.
#include "OptimalMap/MapPoints.h"
#include "TestDensities.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include "Core/OptimalMap/OptimalMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

OptimalMapOptions interpolated()
{
  OptimalMapOptions options;
  options.InterpolatePoints = true;
  return options;
}

// In cells, for points of the same lattice.
template <int D>
double farthest(const Points<D>& a, const Points<D>& b)
{
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      most = std::max(most, std::abs(a[i][axis] - b[i][axis]));
    }
  }
  return most;
}

// The root mean square of second differences along the first axis of the images of a lattice.
template <int D>
double roughness(const Points<D>& images, std::int64_t side)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const std::int64_t at = static_cast<std::int64_t>(i) % side;
    for (int axis = 0; axis < D && at > 0 && at + 1 < side; ++axis)
    {
      const double bend = images[i - 1][axis] - 2.0 * images[i][axis] + images[i + 1][axis];
      sum += bend * bend;
    }
  }
  return std::sqrt(sum / static_cast<double>(images.size()));
}

template <int D>
bool areOnMass(const Points<D>& points, const TestDensity<D>& density)
{
  return std::all_of(points.begin(), points.end(), [&](const Point<D>& point) {
    const std::int64_t cell = cellIndex<D>(cellOf<D>(point, density.Size), density.Size);
    return density.Values[static_cast<std::size_t>(cell)] > 0.0;
  });
}

} // namespace

template <class T>
using InterpolatedPoints = DimensionTest<T>;
TYPED_TEST_SUITE(InterpolatedPoints, Dimensions);

TYPED_TEST(InterpolatedPoints, AreNearTheOptimumAndComeBack)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>());
  const TestDensity<D> source = twoGaussians<D>(size);
  const TestDensity<D> target =
    sampleDensity<D>(size, [](const Point<D>& p) { return 0.5 + p[0] * p[D - 1]; });
  const OptimalMap<D> map = solvedPair<D>(source, target, interpolated());
  EXPECT_LT(map.MassError(), 0.03);
  const Points<D> seeds = latticePoints<D>(size, sideFor<D>());
  Points<D> images(seeds.size());
  map.Backward(seeds, images); // to what is not stretched much when it comes back
  map.Forward(images, images);
  EXPECT_LT(std::sqrt(meanSquare<D>(seeds, images, size)) * static_cast<double>(size[0]), 0.15)
    << "cells";
  map.Forward(seeds, images);
  const OptimalMap<D> exact = solvedPair<D>(source, target);
  Points<D> expected(seeds.size());
  exact.Forward(seeds, expected);
  EXPECT_LT(std::sqrt(meanSquare<D>(images, expected, size)) * static_cast<double>(size[0]), 0.5)
    << "cells";
  const double least = roughness<D>(expected, sideFor<D>());
  EXPECT_LT(roughness<D>(images, sideFor<D>()), (D == 1 ? 1.1 : 0.95) * least);
}

// Steps of the target within few cells, which the correction of masses follows.
TYPED_TEST(InterpolatedPoints, ComeBackFromWhereMassesWereCorrected)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>());
  const TestDensity<D> target = sampleDensity<D>(size, [](const Point<D>& p) {
    return std::fmod(p[0] * static_cast<double>(sideFor<D>()), 8.0) < 4.0 ? 1.0 : 3.0;
  });
  const OptimalMap<D> map = solvedPair<D>(uniformDensity<D>(size), target, interpolated());
  const Points<D> seeds = latticePoints<D>(size, sideFor<D>());
  Points<D> images(seeds.size());
  map.Forward(seeds, images);
  map.Backward(images, images);
  EXPECT_LT(std::sqrt(meanSquare<D>(seeds, images, size)) * static_cast<double>(size[0]),
    D == 2 ? 0.08 : 0.04)
    << "cells";
}

TYPED_TEST(InterpolatedPoints, AreOnMassBothWays)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>());
  const TestDensity<D> source = discWithHole<D>(size);
  const TestDensity<D> target = checker<D>(size, 5);
  const OptimalMap<D> map = solvedPair<D>(source, target, interpolated());
  const Points<D> seeds = latticePoints<D>(size, sideFor<D>() / 2);
  Points<D> images(seeds.size());
  map.Forward(seeds, images);
  EXPECT_TRUE(areOnMass<D>(images, target));
  map.Backward(seeds, images);
  EXPECT_TRUE(areOnMass<D>(images, source));
}

TYPED_TEST(InterpolatedPoints, AreAtRestForEqualDensities)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>());
  const TestDensity<D> density = twoGaussians<D>(size);
  const OptimalMap<D> map = solvedPair<D>(density, density, interpolated());
  const Points<D> seeds = latticePoints<D>(size, sideFor<D>());
  Points<D> images(seeds.size());
  map.Forward(seeds, images);
  EXPECT_LT(farthest<D>(seeds, images), 0.01) << "cells";
  map.Backward(seeds, images);
  EXPECT_LT(farthest<D>(seeds, images), 0.01) << "cells";
}

TYPED_TEST(InterpolatedPoints, HaveTheSameBitsOnAnyThreads)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>());
  const TestDensity<D> source = discWithHole<D>(size);
  const TestDensity<D> target = twoGaussians<D>(size);
  const Points<D> seeds = latticePoints<D>(size, sideFor<D>());
  const OptimalMap<D> expected = solvedPair<D>(source, target, interpolated());
  Points<D> forward(seeds.size());
  Points<D> backward(seeds.size());
  expected.Forward(seeds, forward);
  expected.Backward(seeds, backward);
  for (const int threads : { 1, 2, 5 })
  {
    const ThreadsExecutor executor(threads);
    const OptimalMap<D> map = solvedPair<D>(source, target, interpolated());
    Points<D> images(seeds.size());
    map.Forward(seeds, images, Context(executor));
    EXPECT_TRUE(haveSameBits<D>(images, forward)) << threads;
    map.Backward(seeds, images, Context(executor));
    EXPECT_TRUE(haveSameBits<D>(images, backward)) << threads;
  }
}

} // namespace RectifiedTransport
