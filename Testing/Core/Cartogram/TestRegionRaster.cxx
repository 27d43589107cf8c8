// SPDX-License-Identifier: BSD-3-Clause
// What regions cover of cells, and values that put each region's mass into it.
#include "Core/Cartogram/RegionSets.h"
#include "Core/Cartogram/RegionValues.h"
#include "MapSamples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <numeric>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t side = 40;

RegionRaster rasterOf(const RegionMap& map, std::int32_t regions)
{
  return RegionRaster(map, regions, side);
}

// 9 regions of a map of squares with moved corners.
RegionMap uneven()
{
  RegionMap map = squares(3, true);
  std::mt19937_64 engine(5);
  for (Point<2>& place : map.Points())
  {
    for (double& coordinate : place)
    {
      coordinate = 4.3 + 9.1 * coordinate + 3.0 * static_cast<double>(engine() >> 11) * 0x1p-53;
    }
  }
  return map;
}

TEST(RegionRaster, CoversAreas)
{
  const RegionMap map = uneven();
  const RegionRaster raster = rasterOf(map, 9);
  const std::vector<double> areas = map.Areas(9);
  std::vector<double> covered(9);
  for (std::int32_t region = 0; region < 9; ++region)
  {
    covered[static_cast<std::size_t>(region)] = raster.WholeCells(region);
    EXPECT_GT(raster.WholeCells(region), 10.0);
  }
  raster.VisitMixed([&](std::int32_t set, const RegionRaster::Share* shares, std::int64_t count) {
    double sum = uncoveredPart(set, shares, count);
    for (std::int64_t i = 0; i < count; ++i)
    {
      covered[static_cast<std::size_t>(shares[i].Region)] += shares[i].Part;
      sum += shares[i].Part;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  });
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    EXPECT_NEAR(covered[i], areas[i], 1e-10);
  }
  std::vector<double> overlaps;
  EXPECT_NEAR(raster.Overlap(overlaps), 0.0, 1e-10);
  // The sum of the cells.
  std::vector<double> values{ 1, 2, 3, 4, 5, 6, 7, 8, 9 };
  std::vector<double> cells;
  raster.Fill(values, 0.5, cells);
  const double land = std::accumulate(areas.begin(), areas.end(), 0.0);
  double expected = 0.5 * (side * side - land);
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    expected += values[i] * areas[i];
  }
  EXPECT_NEAR(std::accumulate(cells.begin(), cells.end(), 0.0), expected, 1e-9);
}

// Of several bands of rows, with regions that end near the bands' ends.
TEST(RegionRaster, Bands)
{
  constexpr std::int64_t largeSide = 1500;
  RegionMap map;
  std::int32_t regions = 0;
  for (int row = 0; row < 1490; row += 10)
  {
    for (const double height : { 0.5, 9.75 })
    {
      const double x = height > 1.0 ? 700.0 : 3.25;
      addRing(map, regions++, rectangle(x, row + 0.25, x + 600.5, row + height));
    }
    addRing(map, regions++, rectangle(1400.0, 0.5 + row, 1450.0, 1.5 + row));
  }
  addRing(map, regions++, rectangle(1460.0, 1.0, 1499.5, 1499.5));
  map.FindHoles();
  const RegionRaster raster(map, regions, largeSide);
  const std::vector<double> areas = map.Areas(regions);
  const std::vector<double> covered = raster.Covered();
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    EXPECT_NEAR(covered[i], areas[i], 1e-9 * areas[i]) << i;
  }
  std::vector<double> overlaps;
  EXPECT_EQ(raster.Overlap(overlaps), 0.0);
}

TEST(RegionRaster, Overlap)
{
  RegionMap map;
  addRing(map, 0, rectangle(5.0, 5.0, 15.0, 15.0));
  addRing(map, 1, rectangle(12.5, 5.0, 25.0, 15.0));
  map.FindHoles();
  std::vector<double> overlaps;
  EXPECT_NEAR(rasterOf(map, 2).Overlap(overlaps), 20.0 + 10.0 * 0.5, 1e-9);
  EXPECT_NEAR(overlaps[0], 25.0, 1e-9);
  EXPECT_NEAR(overlaps[1], 25.0, 1e-9);
}

// Squares in each other, with sides between cells, and one that has half of a cell of all of them.
RegionMap nested(std::int32_t count)
{
  RegionMap map;
  for (std::int32_t i = 0; i < count; ++i)
  {
    const double low = 2.3 + 1.7 * i;
    addRing(map, i, rectangle(low, low, 38.0 - low, 38.0 - low));
  }
  addRing(map, count, rectangle(19.5, 19.0, 45.0, 20.0));
  map.FindHoles();
  return map;
}

// A set has one number, in whatever order its regions come and others go.
TEST(RegionSets, Toggled)
{
  constexpr std::int32_t empty = RegionSets::Empty;
  RegionSets sets(6);
  const auto setOf = [&sets](std::int32_t set, std::initializer_list<std::int32_t> regions) {
    for (const std::int32_t region : regions)
    {
      set = sets.Toggled(set, region);
    }
    return set;
  };
  EXPECT_EQ(setOf(empty, { 4 }), 4);
  EXPECT_EQ(setOf(empty, { 4, 4 }), empty);
  const std::int32_t three = setOf(empty, { 0, 3, 5 });
  EXPECT_GE(three, sets.First());
  EXPECT_EQ(setOf(empty, { 5, 3, 0 }), three);
  EXPECT_EQ(setOf(empty, { 5, 1, 0, 4, 3, 1, 4 }), three);
  EXPECT_EQ(setOf(three, { 0, 2, 3, 2 }), 5);
  EXPECT_EQ(setOf(three, { 5, 3, 0 }), empty);
  std::vector<unsigned char> isUsed(static_cast<std::size_t>(sets.End()), 0);
  isUsed[static_cast<std::size_t>(three)] = 1;
  const std::int32_t kept = sets.Keep(isUsed)[static_cast<std::size_t>(three)];
  std::vector<std::int32_t> members;
  sets.VisitRegions(kept, [&](std::int32_t region) { members.push_back(region); });
  EXPECT_EQ(members, (std::vector<std::int32_t>{ 0, 3, 5 }));
}

// Cells that many regions cover together hold the number of their set.
TEST(RegionRaster, SetsOfRegions)
{
  constexpr std::int32_t count = 9;
  const RegionMap map = nested(count);
  const RegionRaster raster = rasterOf(map, count + 1);
  EXPECT_LE(raster.Sets().End() - raster.Sets().First(), 2 * count);
  EXPECT_LE(raster.NumberOfShares(), 2000);
  const std::vector<double> areas = map.Areas(count + 1);
  const std::vector<double> covered = raster.Covered();
  double sum = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    const double inside = i == count ? 20.5 : areas[i];
    EXPECT_NEAR(covered[i], inside, 1e-9) << i;
    sum += inside;
  }
  const double land = areas[0] + 4.3; // of the last region, what the first leaves
  EXPECT_NEAR(raster.UncoveredArea(), side * side - land, 1e-9);
  std::vector<double> overlaps;
  EXPECT_NEAR(raster.Overlap(overlaps), sum - land, 1e-9);
  // A cell has the sum of the values of its regions.
  const std::vector<double> values{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 };
  std::vector<double> cells;
  raster.Fill(values, 0.5, cells);
  EXPECT_NEAR(cells[15 * side + 20], 36.0 + 0.1 * 9.0, 1e-12);
  EXPECT_EQ(cells[19 * side + 20], 55.0);
  EXPECT_DOUBLE_EQ(cells[19 * side + 19], 50.0);
  double expected = 0.5 * raster.UncoveredArea();
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    expected += values[i] * covered[i];
  }
  EXPECT_NEAR(std::accumulate(cells.begin(), cells.end(), 0.0), expected, 1e-9);
  EXPECT_NEAR(raster.MeanOnLand(cells), (expected - 0.5 * raster.UncoveredArea()) / land, 0.02);
}

// The integral of the raster over each region: cell by cell, with the parts that each region has.
std::vector<double> massesIn(
  const RegionRaster& raster, const RegionValues& values, double sea, double least = 0.0)
{
  std::vector<double> cells;
  raster.Fill(values.Densities, sea, cells);
  if (!values.Exponents.empty())
  {
    raster.Scale(values.Exponents, least, cells);
  }
  const std::size_t regions = values.Densities.size();
  std::vector<double> masses(regions);
  for (std::size_t region = 0; region < regions; ++region)
  {
    std::vector<double> only(regions, 0.0);
    only[region] = 1.0;
    std::vector<double> parts;
    raster.Fill(only, 0.0, parts);
    for (std::size_t cell = 0; cell < parts.size(); ++cell)
    {
      masses[region] += parts[cell] * cells[cell];
    }
  }
  return masses;
}

// A ring that has turned over counts as negative.
TEST(RegionRaster, CountsWhatIsTurnedOver)
{
  RegionMap map;
  addRing(map, 0, rectangle(5, 5, 30, 20));
  map.FindHoles();
  std::swap(map.Points()[2], map.Points()[3]); // now it crosses itself
  const RegionRaster raster = rasterOf(map, 1);
  double sum = raster.WholeCells(0);
  double least = 0.0;
  raster.VisitMixed([&](std::int32_t, const RegionRaster::Share* shares, std::int64_t) {
    sum += shares->Signed;
    least = std::min(least, shares->Signed);
    EXPECT_GE(shares->Part, 0.0);
  });
  EXPECT_NEAR(sum, map.Areas(1)[0], 1e-9);
  EXPECT_NEAR(least, -1.0, 1e-12);
  EXPECT_GT(raster.Covered()[0], sum + 10.0);
}

// A pair of triangles that meet in a point, by the even-odd rule.
TEST(RegionRaster, FigureOfEight)
{
  RegionMap map;
  addRing(map, 0, { { 5, 5 }, { 30, 20 }, { 30, 5 }, { 5, 20 } });
  map.FindHoles();
  const RegionRaster raster = rasterOf(map, 1);
  EXPECT_NEAR(raster.Covered()[0], 25.0 * 15.0 / 2.0, 1e-9);
  EXPECT_NEAR(map.Areas(1)[0], 25.0 * 15.0 / 2.0, 1e-9);
  raster.VisitMixed([&](std::int32_t, const RegionRaster::Share* shares, std::int64_t) {
    EXPECT_GT(shares->Signed, 0.0);
  });
}

// A thin strip between dense regions, a quarter of a cell wide: even with no density of its own it
// has too much of its neighbours'.
TEST(RegionValues, FactorsForThinRegions)
{
  RegionMap map;
  addRing(map, 0, rectangle(5, 5, 20.4, 30));
  addRing(map, 1, rectangle(20.4, 5, 20.65, 30));
  addRing(map, 2, rectangle(20.65, 5, 33, 30));
  map.FindHoles();
  const RegionRaster raster = rasterOf(map, 3);
  const std::vector<double> areas = map.Areas(3);
  const std::vector<double> masses{ 2.0 * areas[0], 0.05 * areas[1], 3.0 * areas[2] };
  const double least = 1e-4;
  const RegionValues plain = findRegionValues(raster, { masses, areas, 1.0, least, 1e9 });
  EXPECT_TRUE(plain.Exponents.empty());
  EXPECT_GT(plain.Errors[1], 10.0);
  EXPECT_EQ(plain.Least[1], 1);
  const RegionValues values = findRegionValues(raster, { masses, areas, 1.0, least, 1e-3 });
  const std::vector<double> found = massesIn(raster, values, 1.0, least);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    EXPECT_NEAR(values.Errors[i], 0.0, 1e-3) << i;
    EXPECT_NEAR(found[i] / masses[i] - 1.0, values.Errors[i], 1e-9) << i;
    EXPECT_EQ(values.Least[i], 0);
  }
  // Less than the least density gives.
  const std::vector<double> hopeless{ masses[0], 1e-5 * areas[1], masses[2] };
  const RegionValues most = findRegionValues(raster, { hopeless, areas, 1.0, least, 1e-3 });
  EXPECT_EQ(most.Least[1], 1);
  EXPECT_EQ(most.Least[0], 0);
  EXPECT_GT(most.Errors[1], 1.0);
}

// Squares in each other: an outer one has less than the inner one, and all have their masses.
TEST(RegionValues, FactorsOfSets)
{
  RegionMap map;
  addRing(map, 0, rectangle(2.3, 2.3, 35.2, 35.2));
  addRing(map, 1, rectangle(8.5, 8.5, 30.1, 30.1));
  addRing(map, 2, rectangle(8.5, 8.5, 20.0, 30.1));
  addRing(map, 3, rectangle(25.6, 25.0, 38.0, 38.0));
  map.FindHoles();
  const RegionRaster raster = rasterOf(map, 4);
  const std::vector<double> areas = map.Areas(4);
  const std::vector<double> masses{ 1500.0, 400.0, 300.0, 200.0 };
  const RegionValues values = findRegionValues(raster, { masses, areas, 1.0, 1e-4, 1e-3 });
  const std::vector<double> found = massesIn(raster, values, 1.0, 1e-4);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    EXPECT_NEAR(values.Errors[i], 0.0, 1e-3) << i;
    EXPECT_NEAR(found[i] / masses[i] - 1.0, values.Errors[i], 1e-9) << i;
  }
}

// The integral of the raster over each region is its mass.
TEST(RegionValues, PutMassesIntoRegions)
{
  const RegionMap map = uneven();
  const RegionRaster raster = rasterOf(map, 9);
  const std::vector<double> masses{ 100, 1, 20, 3, 500, 60, 70, 8, 0.9 };
  const std::vector<double> areas = map.Areas(9);
  const double sea = 2.0;
  const RegionValues values = findRegionValues(raster, { masses, areas, sea, 1e-4 * sea, 1.0 });
  const std::vector<double> found = massesIn(raster, values, sea);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    EXPECT_NEAR(found[i] / masses[i] - 1.0, values.Errors[i], 1e-9);
    const bool isFree = values.Least[i] == 0 && values.Densities[i] < 3.999 * masses[i] / areas[i];
    if (isFree)
    {
      EXPECT_NEAR(values.Errors[i], 0.0, 1e-3) << i;
    }
  }
  // Without it, border cells give regions of little mass much of their neighbours'.
  double plain = 0.0;
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    plain = std::max(plain, std::abs(values.Densities[i] / (masses[i] / areas[i]) - 1.0));
  }
  EXPECT_GT(plain, 0.2);
}

} // namespace
} // namespace RectifiedTransport
