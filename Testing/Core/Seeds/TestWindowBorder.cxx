// SPDX-License-Identifier: BSD-3-Clause
// The relaxed border of windows: against the definition, seed by seed, and what it promises.
#include "Core/Seeds/WindowBorder.h"

#include "Core/Parallel/Progress.h"
#include "Core/Seeds/BlueNoiseTile.h"
#include "TestPowerCells.h"
#include "TestSeeds.h"

#include <cmath>

namespace RectifiedTransport
{
namespace
{

void relax(const Point<2>& lengths, Points<2>& unitPoints, const Context& context = Context())
{
  Progress progress(context);
  const auto count = static_cast<std::int64_t>(unitPoints.size());
  const BorderBand band(lengths, count);
  std::vector<BorderSeed> border;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const Point<2>& point = unitPoints[static_cast<std::size_t>(i)];
    if (band.Holds(point.data()))
    {
      border.push_back({ i, point });
    }
  }
  relaxBorder(lengths, count, border, 0, unitPoints, progress);
}

// What a rectangle at a corner of the tile has of it, in the unit square.
Points<2> cutWindow(const Point<2>& lengths)
{
  Points<2> window;
  for (int i = 0; i < BlueNoiseTile<2>::NumberOfPoints; ++i)
  {
    const std::uint16_t* x = BlueNoiseTile<2>::Coordinates + 2 * i;
    const Point<2> place = { x[0] * 0x1p-16 / lengths[0], x[1] * 0x1p-16 / lengths[1] };
    if (std::max(place[0], place[1]) < 1.0)
    {
      window.push_back(place);
    }
  }
  return window;
}

const Point<2> windows[] = { { 0.25, 0.2 }, { 0.125, 0.3 }, { 0.05, 0.3 }, { 0.5, 0.015 },
  { 0.0625, 0.0625 }, { 0.03, 0.04 } };

// The rectangle with one mean spacing as the unit.
Point<2> sidesOf(const Point<2>& lengths, const Points<2>& unitPoints)
{
  const auto count = static_cast<double>(unitPoints.size());
  return { std::sqrt(count * lengths[0] / lengths[1]), std::sqrt(count * lengths[1] / lengths[0]) };
}

Points<2> cellOf(std::size_t seed, const Points<2>& seeds, const Point<2>& sides)
{
  Points<2> cell = { { 0.0, 0.0 }, { sides[0], 0.0 }, sides, { 0.0, sides[1] } };
  const Point<2>& x = seeds[seed];
  for (std::size_t j = 0; j < seeds.size(); ++j)
  {
    if (j != seed)
    {
      const Point<2>& y = seeds[j];
      cell = clipped(cell, { y[0] - x[0], y[1] - x[1] },
        (y[0] * y[0] + y[1] * y[1] - x[0] * x[0] - x[1] * x[1]) / 2.0);
    }
  }
  return cell;
}

// The mean squared distance of the rectangle from the nearest seed, in squared mean spacings.
double energy(const Point<2>& lengths, const Points<2>& unitPoints)
{
  const Point<2> sides = sidesOf(lengths, unitPoints);
  const Points<2> seeds = scaled(unitPoints, sides);
  double sum = 0.0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    sum += costOf(fanMoments(cellOf(i, seeds, sides)), seeds[i]);
  }
  return sum / static_cast<double>(seeds.size());
}

// Relative to the hexagonal lattice's; 1 for one seed.
double smallestSpacing(const Point<2>& lengths, const Points<2>& unitPoints)
{
  const Points<2> seeds = scaled(unitPoints, sidesOf(lengths, unitPoints));
  double smallest = 1.0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const double distance = std::hypot(seeds[i][0] - seeds[j][0], seeds[i][1] - seeds[j][1]);
      smallest = std::min(smallest, distance / std::sqrt(2.0 / std::sqrt(3.0)));
    }
  }
  return smallest;
}

bool isAtBorder(const Point<2>& unitPoint, const Point<2>& sides)
{
  bool isAt = false;
  for (std::size_t a = 0; a < 2; ++a)
  {
    const double bins = std::max(std::floor(sides[a]), 1.0);
    isAt = isAt || unitPoint[a] < 1.0 / bins || unitPoint[a] >= 1.0 - 1.0 / bins;
  }
  return isAt;
}

// How far a seed may go along a step before it is too near to another.
double freePart(std::size_t seed, const Point<2>& step, const Points<2>& seeds)
{
  const double limit = 0.86 * std::sqrt(2.0 / std::sqrt(3.0));
  const double length = std::hypot(step[0], step[1]);
  double part = 1.0;
  for (std::size_t j = 0; j < seeds.size(); ++j)
  {
    const Point<2> y = { seeds[j][0] - seeds[seed][0], seeds[j][1] - seeds[seed][1] };
    const double foot = (y[0] * step[0] + y[1] * step[1]) / length;
    const double height = std::abs(y[0] * step[1] - y[1] * step[0]) / length;
    const double least = std::min(limit, std::hypot(y[0], y[1]));
    if (j != seed && foot > 0.0 && height < least)
    {
      part = std::min(part, (foot - std::sqrt(least * least - height * height)) / length);
    }
  }
  return part;
}

void expectSeedBySeed(const Point<2>& lengths, Points<2> found)
{
  const Point<2> sides = sidesOf(lengths, found);
  Points<2> seeds = scaled(found, sides);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    if (isAtBorder(found[i], sides))
    {
      const PolygonMoments moments = fanMoments(cellOf(i, seeds, sides));
      Point<2>& x = seeds[i];
      const Point<2> step = { 1.5 * (moments.First[0] / moments.Mass - x[0]),
        1.5 * (moments.First[1] / moments.Mass - x[1]) };
      const double part = freePart(i, step, seeds);
      x = { x[0] + part * step[0], x[1] + part * step[1] };
    }
  }
  relax(lengths, found);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    EXPECT_NEAR(found[i][0] * sides[0], seeds[i][0], 1e-9) << found.size() << ", seed " << i;
    EXPECT_NEAR(found[i][1] * sides[1], seeds[i][1], 1e-9) << found.size() << ", seed " << i;
  }
}

TEST(WindowBorder, IsRelaxedSeedBySeed)
{
  for (const Point<2>& lengths : windows)
  {
    expectSeedBySeed(lengths, cutWindow(lengths));
  }
}

// All of them at the border, and some far from where they end.
TEST(WindowBorder, IsRelaxedSeedBySeedAlsoFromRandomPoints)
{
  for (const Point<2>& lengths : { Point<2>{ 1.0, 1.0 }, { 7.0, 1.0 }, { 1.0, 30.0 } })
  {
    for (const std::uint64_t seed : { 1, 2, 22, 33 })
    {
      Points<2> points(60);
      generateSeeds<2>(SeedPattern::Random, lengths, seed, points);
      expectSeedBySeed(lengths, points);
    }
  }
}

TEST(WindowBorder, LeavesWhatIsInside)
{
  const Point<2> lengths = { 0.5, 0.4 };
  const Points<2> before = cutWindow(lengths);
  Points<2> after = before;
  relax(lengths, after);
  const Point<2> sides = sidesOf(lengths, before);
  int moved = 0;
  int atBorder = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    if (isAtBorder(before[i], sides))
    {
      ++atBorder;
      moved += after[i] != before[i] ? 1 : 0;
    }
    else
    {
      EXPECT_EQ(after[i], before[i]);
    }
  }
  EXPECT_GE(moved, 0.95 * atBorder); // some have no way to go
}

TEST(WindowBorder, IsNearerToEveryPoint)
{
  for (const Point<2>& lengths : windows)
  {
    Points<2> points = cutWindow(lengths);
    const double energyBefore = energy(lengths, points);
    const double spacingBefore = smallestSpacing(lengths, points);
    relax(lengths, points);
    EXPECT_LT(energy(lengths, points), 0.985 * energyBefore) << points.size();
    EXPECT_GE(smallestSpacing(lengths, points), std::min(spacingBefore, 0.86) - 1e-12)
      << points.size();
  }
}

// Of any points that are all at the border.
TEST(WindowBorder, NeverCostsMore)
{
  for (const SeedPattern pattern : { SeedPattern::Jittered, SeedPattern::Random })
  {
    for (const Point<2>& lengths : { Point<2>{ 1.0, 1.0 }, { 1.0, 30.0 }, { 1e4, 1.0 } })
    {
      for (const std::size_t count : { 1, 2, 3, 4, 7, 20, 60 })
      {
        Points<2> points(count);
        generateSeeds<2>(pattern, lengths, 5, points);
        const double energyBefore = energy(lengths, points);
        const double spacingBefore = smallestSpacing(lengths, points);
        relax(lengths, points);
        SCOPED_TRACE(testing::Message() << count << " in " << testing::PrintToString(lengths));
        EXPECT_LT(energy(lengths, points), energyBefore);
        EXPECT_GE(smallestSpacing(lengths, points), std::min(spacingBefore, 0.86) - 1e-12);
        for (const Point<2>& point : points)
        {
          EXPECT_GE(std::min(point[0], point[1]), 0.0);
          EXPECT_LE(std::max(point[0], point[1]), 1.0);
        }
      }
    }
  }
}

// The mean area of the cells of those blue-noise seeds whose distance from the faces is between
// these mean spacings, times the seeds per area.
double meanCell(double nearest, double farthest)
{
  constexpr int count = 400;
  constexpr double side = 20.0;
  double area = 0.0;
  double found = 0.0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
  {
    Points<2> points(count);
    generateSeeds<2>(SeedPattern::BlueNoise, { 1.0, 1.0 }, seed, points);
    points = scaled(points, { side, side });
    PowerDiagram diagram({ side, side });
    Progress progress{ Context() };
    diagram.SetSites(points, progress);
    diagram.Update(std::vector<double>(count, 0.0).data(), progress);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const Point<2>& x = points[static_cast<std::size_t>(i)];
      const double distance = std::min({ x[0], x[1], side - x[0], side - x[1] });
      if (distance >= nearest && distance < farthest)
      {
        area += fanMoments(cornersOf(diagram[i])).Mass;
        found += 1.0;
      }
    }
  }
  return area / found;
}

TEST(WindowBorder, HasCellsAsLargeAsThoseInside)
{
  // Lloyd's method does not make areas equal: those of the first row are smaller, of the second
  // larger. More of the density would be at the faces if the sums were different, too.
  EXPECT_NEAR(meanCell(0.0, 1.0), 0.98, 0.015);
  EXPECT_NEAR(meanCell(1.0, 2.0), 1.015, 0.015);
  EXPECT_NEAR(meanCell(0.0, 2.0), 1.0, 0.01);
  EXPECT_NEAR(meanCell(0.0, 3.0), 1.0, 0.005);
}

TEST(WindowBorder, DoesNotDependOnTheUnit)
{
  const Points<2> window = cutWindow({ 0.25, 0.2 });
  Points<2> points = window;
  relax({ 0.25, 0.2 }, points);
  for (const double unit : { 0x1p-1000, 0x1p1000 })
  {
    Points<2> others = window;
    relax({ 0.25 * unit, 0.2 * unit }, others);
    EXPECT_EQ(others, points);
  }
}

// While seeds are searched for those at the border, and while these are moved.
TEST(WindowBorder, IsCancelled)
{
  for (const Point<2>& lengths : { Point<2>{ 1.0, 1.0 }, { 20000.0, 2.0 } })
  {
    Points<2> points(lengths[0] == 1.0 ? 70000 : 40000);
    generateSeeds<2>(SeedPattern::Jittered, lengths, 1, points);
    const Points<2> before = points;
    Context context;
    context.IsCancelled = []() { return true; };
    EXPECT_THROW(relax(lengths, points, context), Cancelled);
    EXPECT_EQ(points, before);
  }
}

} // namespace
} // namespace RectifiedTransport
