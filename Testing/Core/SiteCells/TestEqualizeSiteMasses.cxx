// SPDX-License-Identifier: BSD-3-Clause
// The masses of pixels, pixels that move until groups of sites have equal masses, and groups that
// are divided among their sites.
#include "Core/SiteCells/EqualMasses/EqualizeSiteMasses.h"
#include "Core/SiteCells/EqualMasses/SplitSharedPixels.h"
#include "Core/SiteCells/PixelMasses.h"

#include "TestFlow.h"
#include "TestMasses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

namespace RectifiedTransport
{
namespace
{

using Labels = std::vector<std::int64_t>;

// The oracle sums over the boxes of the pixels in the tables.
template <int Dimension>
void expectMasses(
  const TestDensity<Dimension>& density, const NotDeduced<GridSize<Dimension>>& pixels)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const PixelMasses<Dimension> masses = massesOf<Dimension>(density, pixels);
  const auto step = latticeStep<Dimension>(pixels, density.Size);
  const double total = std::ldexp(1.0, 58);
  std::int64_t sum = 0;
  std::int64_t heaviest = 0;
  std::int64_t withMass = 0;
  ASSERT_EQ(masses.NumberOfPixels(), cellCount<Dimension>(pixels));
  for (std::int64_t pixel = 0; pixel < masses.NumberOfPixels(); ++pixel)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(pixel, pixels);
    Point<Dimension> low;
    Point<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      low[axis] = static_cast<double>(cell[axis]) * step[axis];
      high[axis] = static_cast<double>(cell[axis] + 1) * step[axis];
    }
    ASSERT_NEAR(static_cast<double>(masses[pixel]) / total, flow.Share(low, high), 1e-13) << pixel;
    sum += masses[pixel];
    heaviest = std::max(heaviest, masses[pixel]);
    withMass += masses[pixel] > 0 ? 1 : 0;
  }
  EXPECT_EQ(masses.Total(), sum);
  EXPECT_NEAR(static_cast<double>(sum) / total, 1.0, 1e-13);
  EXPECT_EQ(masses.Heaviest(), heaviest);
  EXPECT_EQ(masses.PixelsWithMass(), withMass);
}

TEST(PixelMasses, AreIntegralsOfTheDensity)
{
  expectMasses<1>(randomCells<1>({ 40 }, 0.1), { 40 });
  expectMasses<1>(randomCells<1>({ 40 }, 0.1), { 17 });
  expectMasses<2>(randomCells<2>({ 30, 20 }, 0.1), { 30, 20 });
  expectMasses<2>(randomCells<2>({ 30, 20 }, 0.1), { 7, 13 });
  expectMasses<2>(randomCells<2>({ 30, 20 }, 0.1), { 101, 77 });
  expectMasses<2>(randomCells<2>({ 30, 20 }, 0.1), { 8, 90 });
  expectMasses<2>(discWithHole<2>({ 30, 20 }), { 60, 40 });
  expectMasses<3>(randomCells<3>({ 10, 7, 5 }, 0.1), { 4, 9, 5 });
  expectMasses<3>(discWithHole<3>({ 10, 7, 12 }), { 21, 5, 7 });
}

// Exact where they are, in units: numbers near the ends of their range are no trouble.
TEST(PixelMasses, DoNotDependOnTheUnitOfTheDensity)
{
  TestDensity<2> density = randomCells<2>({ 30, 20 }, 0.1);
  const PixelMasses<2> usual = massesOf<2>(density, { 50, 31 });
  for (const double unit : { 0x1p-1030, 0x1p1000 })
  {
    TestDensity<2> scaled = density;
    for (double& value : scaled.Values)
    {
      value *= unit;
    }
    const PixelMasses<2> masses = massesOf<2>(scaled, { 50, 31 });
    for (std::int64_t pixel = 0; pixel < usual.NumberOfPixels(); ++pixel)
    {
      // Subnormal values have 44 bits here.
      ASSERT_NEAR(static_cast<double>(masses[pixel]), static_cast<double>(usual[pixel]),
        1e-12 * static_cast<double>(usual[pixel]));
    }
  }
}

// One site a group.
SiteGroups singleGroups(std::int64_t count)
{
  SiteGroups groups;
  groups.First.resize(static_cast<std::size_t>(count) + 1);
  groups.Sites.resize(static_cast<std::size_t>(count));
  std::iota(groups.First.begin(), groups.First.end(), std::int64_t{ 0 });
  std::iota(groups.Sites.begin(), groups.Sites.end(), std::int64_t{ 0 });
  return groups;
}

template <int Dimension>
void expectBalanced(const TestDensity<Dimension>& density,
  const NotDeduced<GridSize<Dimension>>& pixels, std::int64_t count, const std::string& what)
{
  const PixelMasses<Dimension> masses = massesOf<Dimension>(density, pixels);
  const auto places = randomPoints<Dimension>(pixels, static_cast<std::size_t>(count), 4);
  // Every pixel to the nearest site, and to any.
  Labels nearest(static_cast<std::size_t>(masses.NumberOfPixels()));
  Labels any(nearest.size());
  std::mt19937_64 engine(9);
  for (std::size_t pixel = 0; pixel < nearest.size(); ++pixel)
  {
    const auto cell = cellAt<Dimension>(static_cast<std::int64_t>(pixel), pixels);
    double best = HUGE_VAL;
    for (std::int64_t i = 0; i < count; ++i)
    {
      double distance = 0.0;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const double d = static_cast<double>(cell[axis]) + 0.5 - places[i][axis];
        distance += d * d;
      }
      nearest[pixel] = distance < best ? i : nearest[pixel];
      best = std::min(best, distance);
    }
    any[pixel] = static_cast<std::int64_t>(engine() % static_cast<std::uint64_t>(count));
  }
  for (Labels* labels : { &nearest, &any })
  {
    equalizeSiteMasses<Dimension>(
      singleGroups(count), masses, places, evenPoint<Dimension>(1.0), labels->data());
    const Shares shares = sharesOf<Dimension>(masses, *labels, count);
    EXPECT_LE(shares.Deviation(), static_cast<double>(masses.Heaviest()))
      << what << (labels == &any ? ", any" : ", nearest");
  }
}

TEST(EqualizeSiteMasses, AnyCellsAreBalanced)
{
  expectBalanced<2>(twoGaussians<2>({ 60, 50 }), { 60, 50 }, 20, "Gaussians");
  expectBalanced<2>(twoGaussians<2>({ 60, 50 }), { 120, 90 }, 40, "Gaussians, fine");
  expectBalanced<2>(randomCells<2>({ 60, 50 }, 0.0), { 60, 50 }, 40, "noise");
  expectBalanced<2>(uniformDensity<2>({ 40, 30 }), { 40, 30 }, 37, "uniform");
  expectBalanced<2>(uniformDensity<2>({ 40, 1 }), { 40, 1 }, 5, "line");
  expectBalanced<3>(twoGaussians<3>({ 16, 14, 12 }), { 16, 14, 12 }, 25, "volume");
}

// Cells on both sides of what has no mass, or next to none, exchange what is behind it.
TEST(EqualizeSiteMasses, AcrossEmptyRegions)
{
  for (const double between : { 0.0, 1e-9 })
  {
    TestDensity<2> density = uniformDensity<2>({ 90, 20 }, between);
    for (std::size_t i = 0; i < density.Values.size(); ++i)
    {
      density.Values[i] += i % 90 < 20 ? 1.0 : i % 90 >= 60 ? 1.0 : 0.0;
    }
    const PixelMasses<2> masses = massesOf<2>(density, { 90, 20 });
    Labels labels(1800);
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      labels[i] = i % 90 < 40 ? 0 : 1;
    }
    const Points<2> places = { { 10.0, 10.0 }, { 75.0, 10.0 } };
    equalizeSiteMasses<2>(singleGroups(2), masses, places, { 1.0, 1.0 }, labels.data());
    const Shares shares = sharesOf<2>(masses, labels, 2);
    EXPECT_LE(shares.Deviation(), static_cast<double>(masses.Heaviest())) << between;
    // The left cell has reached over to the right.
    EXPECT_EQ(labels[10 * 90 + 30], 0) << between;
    EXPECT_EQ(labels[10 * 90 + 89], 1) << between;
    EXPECT_EQ(labels[10 * 90 + 61], 0) << between;
  }
}

// Groups of several sites get as many shares.
TEST(EqualizeSiteMasses, GroupsOfSites)
{
  const TestDensity<2> density = twoGaussians<2>({ 60, 50 });
  const PixelMasses<2> masses = massesOf<2>(density, { 60, 50 });
  const SiteGroups groups{ { 0, 1, 4, 6 }, { 0, 1, 2, 3, 4, 5 } };
  Labels labels(3000);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    labels[i] = static_cast<std::int64_t>(i % 60 / 20);
  }
  const Points<2> places = { { 10.0, 25.0 }, { 30.0, 25.0 }, { 50.0, 25.0 } };
  equalizeSiteMasses<2>(groups, masses, places, { 1.0, 1.0 }, labels.data());
  std::vector<double> sums(3, 0.0);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    sums[static_cast<std::size_t>(labels[i])] += static_cast<double>(masses[i]);
  }
  const double each = static_cast<double>(masses.Total()) / 6.0;
  const auto heaviest = static_cast<double>(masses.Heaviest());
  EXPECT_NEAR(sums[0], each, heaviest);
  EXPECT_NEAR(sums[1], 3.0 * each, heaviest);
  EXPECT_NEAR(sums[2], 2.0 * each, heaviest);
  // The sites of each group divide it.
  const Points<2> sites = { { 9.0, 9.0 }, { 29.0, 9.0 }, { 29.0, 20.0 }, { 29.0, 30.0 },
    { 50.0, 9.0 }, { 50.0, 9.0 } };
  splitGroupsByMass<2>(groups, masses, sites, { 1.0, 1.0 }, labels.data());
  const Shares shares = sharesOf<2>(masses, labels, 6);
  EXPECT_LE(shares.Deviation(), heaviest);
}

// Where one pixel has the mass of several shares every site gets a pixel with mass nevertheless.
TEST(SplitGroupsByMass, HeavyPixels)
{
  TestDensity<2> density = uniformDensity<2>({ 8, 8 }, 0.0);
  density.Values[0] = 1000.0;
  density.Values[1] = 1.0;
  density.Values[2] = 1.0;
  density.Values[63] = 2.0;
  const PixelMasses<2> masses = massesOf<2>(density, { 8, 8 });
  const SiteGroups groups{ { 0, 4 }, { 0, 1, 2, 3 } };
  const Points<2> sites = { { 1.0, 1.0 }, { 2.0, 1.0 }, { 3.0, 1.0 }, { 4.0, 1.0 } };
  Labels labels(64, 0);
  splitGroupsByMass<2>(groups, masses, sites, { 1.0, 1.0 }, labels.data());
  EXPECT_GT(sharesOf<2>(masses, labels, 4).Least, 0);
}

} // namespace
} // namespace RectifiedTransport
