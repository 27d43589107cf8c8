// SPDX-License-Identifier: BSD-3-Clause
// Particles in cells: uneven ones become even, independent ones nearly stay, none leaves its cell.
#include "Core/OptimalMap/Masses/SampleCorrection.h"

#include "OptimalMap/Masses/ParticleMasses.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

template <int D>
Particles<D> spread(const GridSize<D>& size, Particles<D> particles,
  const Context& context = Context(SerialExecutor()))
{
  Progress progress(context);
  progress.Expect(2 * D * static_cast<std::int64_t>(particles.size()));
  equalizeInSlabs<D>(size, particles, progress);
  return particles;
}

template <int D>
GridSize<D> someSize()
{
  return sizeFor<D>({ 30 }, { 37, 22 }, { 13, 9, 16 });
}

// Replaces the place x in the cell by place(cell, x), along each axis.
template <int D, class Place>
Particles<D> replaced(const GridSize<D>& size, Particles<D> particles, const Place& place)
{
  for (Point<D>& particle : particles)
  {
    const GridSize<D> cell = cellOf<D>(particle, size);
    for (int axis = 0; axis < D; ++axis)
    {
      const auto corner = static_cast<double>(cell[axis]);
      particle[axis] = corner + place(cell[axis], particle[axis] - corner);
    }
  }
  return particles;
}

// Chi-square over its degrees of freedom, of the halves of all slabs across all axes.
template <int D>
double unevenness(const GridSize<D>& size, const Particles<D>& particles)
{
  double sum = 0.0;
  int slabs = 0;
  for (int axis = 0; axis < D; ++axis)
  {
    std::vector<double> counts(static_cast<std::size_t>(2 * size[axis]), 0.0);
    for (const Point<D>& particle : particles)
    {
      const std::int64_t half =
        std::min(2 * size[axis] - 1, static_cast<std::int64_t>(2 * particle[axis]));
      ++counts[static_cast<std::size_t>(half)];
    }
    for (std::size_t i = 0; i < counts.size(); i += 2, ++slabs)
    {
      const double difference = counts[i] - counts[i + 1];
      sum += difference * difference / std::max(1.0, counts[i] + counts[i + 1]);
    }
  }
  return sum / slabs;
}

template <int D>
double meanWay(const Particles<D>& a, const Particles<D>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    double square = 0.0;
    for (int axis = 0; axis < D; ++axis)
    {
      square += (a[i][axis] - b[i][axis]) * (a[i][axis] - b[i][axis]);
    }
    sum += std::sqrt(square) / static_cast<double>(a.size());
  }
  return sum;
}

template <class T>
using SlabEqualization = DimensionTest<T>;
TYPED_TEST_SUITE(SlabEqualization, Dimensions, );

TYPED_TEST(SlabEqualization, MakesThemEvenAndKeepsTheirCellsAndOrder)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  const Particles<D> even = samplesOf<D>(twoGaussians<D>(size), 40000);
  // Not alike in neighbouring slabs.
  const auto bend = [](std::int64_t cell, double x) {
    return std::pow(x, cell % 2 == 0 ? 1.2 : 0.8);
  };
  const Particles<D> uneven = replaced<D>(size, even, bend);
  const Particles<D> after = spread<D>(size, uneven);
  EXPECT_GT(unevenness<D>(size, uneven), D == 1 ? 3.0 : 4.0);
  EXPECT_LT(unevenness<D>(size, after), 1.3);
  EXPECT_LT(meanWay<D>(after, even), 0.5 * meanWay<D>(uneven, even));
  for (std::size_t i = 0; i < after.size(); ++i)
  {
    ASSERT_EQ(cellOf<D>(after[i], size), cellOf<D>(uneven[i], size));
    for (std::size_t j = i + 1; j < std::min(i + 50, after.size()); ++j)
    {
      if (cellOf<D>(after[i], size) == cellOf<D>(after[j], size))
      {
        for (int axis = 0; axis < D; ++axis)
        {
          ASSERT_EQ(after[i][axis] < after[j][axis], uneven[i][axis] < uneven[j][axis]);
        }
      }
    }
  }
}

TYPED_TEST(SlabEqualization, HardlyMovesIndependentParticles)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  for (const std::size_t number : { 0U, 1U, 20U, 3000U, 100000U })
  {
    const Particles<D> before = samplesOf<D>(uniformDensity<D>(size), number);
    const Particles<D> after = spread<D>(size, before);
    EXPECT_LT(meanWay<D>(before, after), 0.025) << number;
    if (number < 32)
    {
      EXPECT_LT(meanWay<D>(before, after), 1e-12) << number;
    }
  }
}

TYPED_TEST(SlabEqualization, KeepsParticlesOnFacesInTheirCells)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  Particles<D> particles = samplesOf<D>(uniformDensity<D>(size), 20000);
  for (Point<D>& particle : particles)
  {
    for (double& coordinate : particle)
    {
      coordinate = std::round(coordinate);
    }
  }
  const Particles<D> after = spread<D>(size, particles);
  EXPECT_TRUE(areInBox<D>(size, after));
  for (std::size_t i = 0; i < after.size(); ++i)
  {
    ASSERT_EQ(cellOf<D>(after[i], size), cellOf<D>(particles[i], size));
  }
}

TYPED_TEST(SlabEqualization, GivesTheSameBitsForAnyThreadsAndOrder)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  const auto bend = [](std::int64_t, double x) { return x * x; };
  Particles<D> particles = replaced<D>(size, samplesOf<D>(uniformDensity<D>(size), 200000), bend);
  const Particles<D> expected = spread<D>(size, particles);
  for (const int threads : { 2, 3 })
  {
    const ThreadsExecutor executor(threads);
    EXPECT_EQ(spread<D>(size, particles, Context(executor)), expected) << threads << " threads";
  }
  std::reverse(particles.begin(), particles.end());
  Particles<D> reversed = spread<D>(size, particles);
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_EQ(reversed, expected);
}

} // namespace
} // namespace RectifiedTransport
