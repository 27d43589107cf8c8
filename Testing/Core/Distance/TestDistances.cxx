// SPDX-License-Identifier: BSD-3-Clause
// Distances of densities whose W2 is known, and points from distances.
#include "Core/Distance/CertifiedDistance.h"
#include "Core/Distance/ClassicalScaling.h"
#include "Core/Distance/DensityMoments.h"
#include "Core/Distance/ReferenceImages.h"
#include "TestDensities.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// A bell over nothing, at a place in the unit box.
template <int D>
TestDensity<D> bell(std::int64_t side, const Point<D>& place, double deviation = 0.06)
{
  TestDensity<D> density;
  density.Size = evenSize<D>(side);
  const auto cells = static_cast<std::int64_t>(numberOfCells<D>(density.Size));
  for (std::int64_t i = 0; i < cells; ++i)
  {
    std::int64_t rest = i;
    double square = 0.0;
    for (const double x : place)
    {
      const double way = (static_cast<double>(rest % side) + 0.5) / static_cast<double>(side) - x;
      square += way * way;
      rest /= side;
    }
    density.Values.push_back(
      square < 0.04 ? std::exp(-square / (2.0 * deviation * deviation)) : 0.0);
  }
  return density;
}

template <int D>
SquaredBracket bracket(
  const TestDensity<D>& a, const TestDensity<D>& b, const Context& context = Context())
{
  return bracketDistance<D>(a.Source(), b.Source(), evenPoint<D>(1.0), context);
}

template <int D>
double linearized(
  const TestDensity<D>& a, const TestDensity<D>& b, const Context& context = Context())
{
  const Point<D> sides = evenPoint<D>(1.0);
  return meanSquaredDistance<D>(
    mapReference<D>(a.Source(), sides, context), mapReference<D>(b.Source(), sides, context));
}

template <int D>
DensityMoments moments(const TestDensity<D>& density)
{
  return momentsOf<D>(density.Source(), density.Size, evenPoint<D>(1.0));
}

// By whole cells, so that the shapes are the same.
template <int D>
void testTranslation(std::int64_t side)
{
  Point<D> low = evenPoint<D>(0.375);
  Point<D> high = low;
  high[0] += 0.25;
  const TestDensity<D> a = bell<D>(side, low);
  const TestDensity<D> b = bell<D>(side, high);
  constexpr double square = 0.0625;
  const SquaredBracket found = bracket<D>(a, b);
  EXPECT_LE(found.Lower, square * (1.0 + 1e-9));
  EXPECT_GE(found.Lower, 0.98 * square);
  EXPECT_GE(found.Upper, square * (1.0 - 1e-9));
  EXPECT_LE(found.Upper, 1.1 * square);
  EXPECT_NEAR(linearized<D>(a, b) / square, 1.0, 0.05);
  EXPECT_NEAR(leastSquaredDistance(moments(a), moments(b)) / square, 1.0, 1e-6);
}

TEST(Distances, AreThoseOfTranslations)
{
  testTranslation<1>(64);
  testTranslation<2>(48);
  testTranslation<3>(24);
}

// The moments of bells of other widths know the distance, too.
TEST(Distances, AreThoseOfWidths)
{
  const Point<2> middle = evenPoint<2>(0.5);
  const TestDensity<2> narrow = bell<2>(64, middle, 0.02);
  const TestDensity<2> wide = bell<2>(64, middle, 0.04);
  const double least = leastSquaredDistance(moments(narrow), moments(wide));
  EXPECT_NEAR(least, 2.0 * 0.02 * 0.02, 0.06 * 0.02 * 0.02);
  const SquaredBracket found = bracket<2>(narrow, wide);
  EXPECT_LE(found.Lower, 1.01 * least);
  EXPECT_GE(found.Upper, 0.99 * least);
}

// Whatever the cells: each of them is spread, too.
TEST(DensityMoments, AreThoseOfABox)
{
  const std::vector<double> ones(2 * 5, 1.0);
  const DensityMoments found =
    momentsOf<2>(DensityArray<2, double>(ones.data(), { 2, 5 }), { 2, 5 }, { 3.0, 4.0 });
  EXPECT_NEAR(found.Mean[0], 1.5, 1e-12);
  EXPECT_NEAR(found.Mean[1], 2.0, 1e-12);
  EXPECT_NEAR(found.Covariance[0][0], 9.0 / 12.0, 1e-12);
  EXPECT_NEAR(found.Covariance[1][1], 16.0 / 12.0, 1e-12);
  EXPECT_NEAR(found.Covariance[0][1], 0.0, 1e-12);
}

// Shapes that turn and merge, for which the first coupling is far from enough.
TEST(Distances, HaveBoundsThatAreNear)
{
  const TestDensity<2> one = bell<2>(48, evenPoint<2>(0.5), 0.05);
  TestDensity<2> two = bell<2>(48, { 0.3, 0.35 }, 0.03);
  const TestDensity<2> other = bell<2>(48, { 0.75, 0.6 }, 0.04);
  for (std::size_t i = 0; i < two.Values.size(); ++i)
  {
    two.Values[i] += 0.6 * other.Values[i];
  }
  const SquaredBracket found = bracket<2>(one, two);
  EXPECT_LE(found.Upper, 1.05 * found.Lower);
}

TEST(Distances, OfADensityAndItselfAreNothing)
{
  const TestDensity<2> a = bell<2>(32, evenPoint<2>(0.5));
  EXPECT_EQ(bracket<2>(a, a).Lower, 0.0);
  EXPECT_EQ(linearized<2>(a, a), 0.0);
  EXPECT_EQ(leastSquaredDistance(moments(a), moments(a)), 0.0);
}

TEST(Distances, DoNotDependOnMass)
{
  const TestDensity<2> a = bell<2>(32, { 0.4, 0.4 });
  const TestDensity<2> b = bell<2>(32, { 0.6, 0.5 });
  TestDensity<2> heavy = b;
  for (double& value : heavy.Values)
  {
    value *= 8.0;
  }
  EXPECT_EQ(bracket<2>(a, b).Lower, bracket<2>(a, heavy).Lower);
  EXPECT_EQ(linearized<2>(a, b), linearized<2>(a, heavy));
}

// In the box of any sides.
TEST(Distances, ScaleWithTheBox)
{
  const TestDensity<2> a = bell<2>(32, { 0.4, 0.4 });
  const TestDensity<2> b = bell<2>(32, { 0.6, 0.5 });
  const Point<2> sides{ 2.0, 2.0 };
  EXPECT_NEAR(
    bracketDistance<2>(a.Source(), b.Source(), sides).Lower, 4.0 * bracket<2>(a, b).Lower, 1e-12);
  const double found =
    meanSquaredDistance<2>(mapReference<2>(a.Source(), sides), mapReference<2>(b.Source(), sides));
  EXPECT_NEAR(found, 4.0 * linearized<2>(a, b), 1e-10);
}

TEST(Distances, HaveTheSameBitsOnThreads)
{
  const TestDensity<2> a = bell<2>(300, { 0.4, 0.4 });
  const TestDensity<2> b = bell<2>(300, { 0.6, 0.5 });
  const SerialExecutor serial;
  const SquaredBracket one = bracket<2>(a, b, serial);
  const double oneLinear = linearized<2>(a, b, serial);
  for (const int threads : { 2, 3 })
  {
    const ThreadsExecutor several(threads);
    const SquaredBracket found = bracket<2>(a, b, several);
    EXPECT_EQ(found.Lower, one.Lower);
    EXPECT_EQ(found.Upper, one.Upper);
    EXPECT_EQ(linearized<2>(a, b, several), oneLinear);
  }
}

TEST(ReferenceLattice, IsOfCubes)
{
  EXPECT_EQ(referenceLattice<2>({ 1.0, 1.0 }), (GridSize<2>{ 256, 256 }));
  EXPECT_EQ(referenceLattice<2>({ 4.0, 1.0 }), (GridSize<2>{ 512, 128 }));
  EXPECT_EQ(referenceLattice<3>({ 3.0, 3.0, 3.0 }), (GridSize<3>{ 40, 40, 40 }));
  EXPECT_EQ(referenceLattice<2>({ 1e6, 1e-6 })[1], 1);
}

std::vector<double> distancesOf(const std::vector<Point<2>>& points)
{
  std::vector<double> distances;
  for (const Point<2>& a : points)
  {
    for (const Point<2>& b : points)
    {
      distances.push_back(std::hypot(a[0] - b[0], a[1] - b[1]));
    }
  }
  return distances;
}

TEST(ClassicalScaling, FindsPointsOfAPlane)
{
  const std::vector<double> distances =
    distancesOf({ { 0.0, 0.0 }, { 3.0, 1.0 }, { 1.0, -2.0 }, { 5.0, 5.0 }, { -4.0, 2.0 } });
  const ScaledPoints found = scaleClassically(distances, 5, 3);
  EXPECT_NEAR(found.Stress, 0.0, 1e-12);
  std::vector<Point<2>> plane;
  for (std::size_t i = 0; i < 5; ++i)
  {
    plane.push_back({ found.Coordinates[3 * i], found.Coordinates[3 * i + 1] });
    EXPECT_NEAR(found.Coordinates[3 * i + 2], 0.0, 1e-6);
  }
  const std::vector<double> again = distancesOf(plane);
  for (std::size_t i = 0; i < again.size(); ++i)
  {
    EXPECT_NEAR(again[i], distances[i], 1e-12);
  }
}

// Of the corners of a tetrahedron two axes lose a part: the axes are equal, so any plane through
// the centre shows two thirds of the squares.
TEST(ClassicalScaling, SaysWhatIsLost)
{
  std::vector<double> distances(16, 1.0);
  for (std::size_t i = 0; i < 4; ++i)
  {
    distances[5 * i] = 0.0;
  }
  EXPECT_NEAR(scaleClassically(distances, 4, 3).Stress, 0.0, 1e-12);
  const ScaledPoints found = scaleClassically(distances, 4, 2);
  EXPECT_GT(found.Stress, 0.1);
  EXPECT_LT(found.Stress, 0.5);
  double squares = 0.0;
  for (const double x : found.Coordinates)
  {
    squares += x * x;
  }
  EXPECT_NEAR(squares, 1.0, 1e-12); // of 1.5 in space
}

TEST(ClassicalScaling, TakesPointsThatAreOne)
{
  const ScaledPoints found = scaleClassically(std::vector<double>(9, 0.0), 3, 2);
  EXPECT_EQ(found.Stress, 0.0);
  EXPECT_EQ(found.Coordinates, std::vector<double>(6, 0.0));
}

TEST(ClassicalScaling, TakesDistancesNearTheLargestDouble)
{
  std::vector<double> distances{ 0.0, 1e300, 1e300, 0.0 };
  const ScaledPoints found = scaleClassically(distances, 2, 1);
  EXPECT_NEAR(found.Coordinates[0] / 1e300, 0.5, 1e-12);
  EXPECT_NEAR(found.Coordinates[1] / 1e300, -0.5, 1e-12);
}

} // namespace
} // namespace RectifiedTransport
