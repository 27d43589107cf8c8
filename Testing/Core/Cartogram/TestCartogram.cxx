// SPDX-License-Identifier: BSD-3-Clause
// Cartograms: areas are masses, land keeps its area, outlines do not cross.
#include "Core/Overlap/RingCrossings.h"
#include "Core/Parallel/Progress.h"
#include "MapSamples.h"
#include "TestDensities.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace RectifiedTransport
{
namespace
{

CartogramOptions coarse()
{
  CartogramOptions options;
  options.Resolution = 128;
  return options;
}

struct Made
{
  RegionMap Map;
  CartogramBox Box;
  std::vector<double> Before;
  CartogramResult Result;
};

Made make(RegionMap map, const std::vector<double>& masses, const CartogramOptions& options,
  OverlayPoints* overlays = nullptr, const Context& context = Context())
{
  Made made;
  made.Box = boxAround(map, options);
  for (Point<2>& place : map.Points())
  {
    place = made.Box.ToIndex(place);
  }
  made.Map = std::move(map);
  made.Before = made.Map.Areas(static_cast<std::int32_t>(masses.size()));
  OverlayPoints none;
  CartogramStart start;
  made.Result =
    runCartogram(made.Map, masses, made.Box, options, overlays ? *overlays : none, start, context);
  return made;
}

std::vector<double> masses16(double tenth)
{
  std::vector<double> masses(16, 1.0);
  masses[5] = tenth;
  return masses;
}

// Outlines of thin regions beside one a thousand times as dense cross, at any number of steps.
void expectRight(
  const Made& made, const std::vector<double>& masses, double tolerance, bool mayCross = false)
{
  const std::vector<double> areas = made.Map.Areas(static_cast<std::int32_t>(masses.size()));
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  const double land = std::accumulate(areas.begin(), areas.end(), 0.0);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    const double error = areas[i] / land / (masses[i] / total) - 1.0;
    EXPECT_LE(std::abs(error), tolerance) << i;
    EXPECT_NEAR(error, made.Result.Errors[i], 1e-9) << i;
  }
  Progress progress{ Context() };
  for (std::int64_t ring = 0; ring < made.Map.Rings(); ++ring)
  {
    Rings outline;
    for (std::int64_t i = 0; i < made.Map.CountOf(ring); ++i)
    {
      const auto corner = static_cast<std::size_t>(made.Map.CornerOf(ring, i));
      outline.Add(made.Map.Points()[corner]);
    }
    outline.EndRing();
    EXPECT_TRUE(mayCross || !haveCrossings(outline, progress)) << ring;
  }
  EXPECT_EQ(made.Result.Folded, 0);
}

TEST(Cartogram, Squares)
{
  for (const double contrast : { 10.0, 100.0, 1000.0 })
  {
    const std::vector<double> masses = masses16(contrast);
    CartogramOptions options = coarse();
    options.Resolution = contrast > 500.0 ? 512 : 128;
    for (const bool areShared : { false, true })
    {
      const Made made = make(squares(4, areShared), masses, options);
      expectRight(made, masses, 0.01, contrast > 500.0);
      EXPECT_LE(made.Result.Passes.size(), 4U);
      EXPECT_LE(made.Result.Passes.back().LargestError, 0.01);
      const std::vector<double> after = made.Map.Areas(16);
      const double before = std::accumulate(made.Before.begin(), made.Before.end(), 0.0);
      EXPECT_NEAR(std::accumulate(after.begin(), after.end(), 0.0) / before, 1.0, 0.01);
    }
  }
}

TEST(Cartogram, ExactAsAsked)
{
  CartogramOptions options = coarse();
  options.Tolerance = 1e-3;
  const std::vector<double> masses = masses16(30.0);
  expectRight(make(squares(4), masses, options), masses, 1e-3);
}

TEST(Cartogram, ShortEdgesWhereRegionsGrow)
{
  CartogramOptions options = coarse();
  options.MaximumPasses = 1;
  const Made made = make(squares(4), masses16(90.0), options);
  const auto longest = [&](std::int64_t ring) {
    double length = 0.0;
    made.Map.VisitEdges(ring, [&](std::int64_t from, std::int64_t to) {
      const Point<2>& a = made.Result.Before[static_cast<std::size_t>(from)];
      const Point<2>& b = made.Result.Before[static_cast<std::size_t>(to)];
      length = std::max(length, std::hypot(b[0] - a[0], b[1] - a[1]));
    });
    return length;
  };
  const double usual = 128.0 / 512.0;
  EXPECT_NEAR(longest(15), usual, 0.01);
  // 13.7 times as dense as all together.
  EXPECT_NEAR(longest(5), usual / std::sqrt(13.7), 0.01);
}

TEST(Cartogram, NothingToDo)
{
  const std::vector<double> masses(16, 2.5);
  const Made made = make(squares(4), masses, coarse());
  EXPECT_EQ(made.Result.Passes.size(), 1U);
  for (std::size_t i = 0; i < made.Map.Points().size(); ++i)
  {
    EXPECT_NEAR(made.Map.Points()[i][0], made.Result.Before[i][0], 0.05);
    EXPECT_NEAR(made.Map.Points()[i][1], made.Result.Before[i][1], 0.05);
  }
}

TEST(Cartogram, OneRegion)
{
  const Made made = make(squares(1), { 3.0 }, coarse());
  EXPECT_NEAR(made.Map.Areas(1)[0] / made.Before[0], 1.0, 1e-3);
}

// A lake with an island, and a region in two pieces.
TEST(Cartogram, HolesAndPieces)
{
  RegionMap map;
  addRing(map, 0, rectangle(0, 0, 6, 6));
  addRing(map, 0, rectangle(2, 2, 4, 4));
  addRing(map, 1, rectangle(2, 2, 4, 4));
  addRing(map, 2, rectangle(6, 0, 8, 6));
  addRing(map, 2, rectangle(9, 0, 10, 3));
  map.FindHoles();
  const std::vector<double> masses{ 1.0, 3.0, 2.0 };
  expectRight(make(std::move(map), masses, coarse()), masses, 0.01);
}

// The sea is a density as any other.
TEST(Cartogram, Seas)
{
  const std::vector<double> masses = masses16(4.0);
  double land[4];
  for (const SeaDensity sea :
    { SeaDensity::Mean, SeaDensity::Minimum, SeaDensity::Value, SeaDensity::Zero })
  {
    CartogramOptions options = coarse();
    options.Sea = sea;
    options.SeaValue = 0.3;
    options.MaximumPasses = 4;
    const Made made = make(squares(4), masses, options);
    expectRight(made, masses, 0.02);
    const std::vector<double> areas = made.Map.Areas(16);
    land[static_cast<int>(sea)] = std::accumulate(areas.begin(), areas.end(), 0.0) / 16384.0;
    // What is foretold of the land.
    EXPECT_NEAR(land[static_cast<int>(sea)] * 1.44 / made.Result.Growth, 1.0, 0.011);
  }
  EXPECT_NEAR(land[0], 1.0 / 1.44, 0.01);
  EXPECT_GT(land[1], land[0]);
  EXPECT_GT(land[2], land[1]);
  EXPECT_GT(land[3], 0.97);
}

// Points move as the map's points in the same places.
TEST(Cartogram, OverlayPoints)
{
  const std::vector<double> masses = masses16(50.0);
  const CartogramOptions options = coarse();
  RegionMap map = squares(4);
  const CartogramBox box = boxAround(map, options);
  OverlayPoints overlays;
  for (const Point<2>& place : map.Points())
  {
    overlays.push_back(box.ToIndex(place));
  }
  const std::size_t corners = overlays.size();
  overlays.push_back({ -3.0, 200.0 }); // beyond the corner, which does not move
  const Made made = make(std::move(map), masses, options, &overlays);
  for (std::size_t i = 0; i < corners; ++i)
  {
    EXPECT_EQ(overlays[i], made.Map.Points()[i]);
  }
  EXPECT_NEAR(overlays.back()[0], -3.0, 0.05);
  EXPECT_NEAR(overlays.back()[1], 200.0, 0.05);
}

TEST(Cartogram, SameForThreads)
{
  const std::vector<double> masses = masses16(100.0);
  const Made one = make(squares(4), masses, coarse());
  const ThreadsExecutor threads(3);
  const Made other = make(squares(4), masses, coarse(), nullptr, threads);
  EXPECT_EQ(one.Map.Points(), other.Map.Points());
}

// Many regions of masses that span a factor of 1000, on few cells each: thin ones have most of the
// raster's mass from their neighbours, small ones need more steps than blocks of cells, and edges
// must follow densities that differ from cell to cell.
TEST(Cartogram, ManyRegions)
{
  struct Case
  {
    int Side;
    std::int64_t Resolution;
    double Tolerance;
    std::size_t Passes; // at most
  };
  for (const Case& sample :
    { Case{ 24, 256, 0.02, 3 }, Case{ 16, 128, 0.01, 5 }, Case{ 16, 256, 0.003, 3 } })
  {
    std::mt19937_64 engine(3);
    std::vector<double> masses;
    for (int i = 0; i < sample.Side * sample.Side; ++i)
    {
      double sum = -6.0; // of 12 even numbers: nearly normal
      for (int k = 0; k < 12; ++k)
      {
        sum += static_cast<double>(engine() >> 11) * 0x1p-53;
      }
      masses.push_back(std::exp(1.2 * sum));
    }
    CartogramOptions options;
    options.Resolution = sample.Resolution;
    options.Tolerance = sample.Tolerance;
    const Made made = make(squares(sample.Side), masses, options);
    expectRight(made, masses, sample.Tolerance, true);
    EXPECT_LE(made.Result.Passes.size(), sample.Passes);
    EXPECT_TRUE(made.Result.OutOfReach.empty());
  }
}

// A region that is smaller than a cell of the raster in a dense neighbourhood.
TEST(Cartogram, OutOfReach)
{
  CartogramOptions options = coarse();
  options.Resolution = 32;
  RegionMap map;
  addRing(map, 0, rectangle(0, 0, 10, 10));
  addRing(map, 0, rectangle(5, 5, 5.1, 5.1));
  addRing(map, 1, rectangle(5, 5, 5.1, 5.1));
  map.FindHoles();
  const Made made = make(std::move(map), { 1.0, 1e-9 }, options);
  EXPECT_EQ(made.Result.OutOfReach, std::vector<std::int32_t>{ 1 });
  EXPECT_GT(made.Result.Errors[1], 0.01);
  EXPECT_LE(std::abs(made.Result.Errors[0]), 0.01);
}

// Few steps turn outlines over; more do not, or the pass is left out.
TEST(Cartogram, MoreStepsWhereOutlinesTurnOver)
{
  RegionMap map = squares(4);
  for (int i = 0; i < 400; ++i) // small islands all over it
  {
    const double x = 0.2 * (i % 20) + 0.09;
    const double y = 0.2 * (i / 20) + 0.09;
    addRing(map, 16, rectangle(x, y, x + 0.005, y + 0.005));
  }
  map.FindHoles();
  CartogramOptions options = coarse();
  options.Flow.NumberOfSteps = 4;
  options.MaximumPasses = 1;
  for (const double heavy : { 1e4, 1e8 })
  {
    std::vector<double> masses = masses16(heavy);
    masses.push_back(0.01);
    const Made made = make(map, masses, options);
    const bool isLeftOut = heavy > 1e6;
    EXPECT_EQ(made.Result.Folded > 0, isLeftOut);
    ASSERT_EQ(made.Result.Passes.size(), isLeftOut ? 0U : 1U);
    EXPECT_TRUE(isLeftOut || made.Result.Passes[0].NumberOfSteps >= 2 * FlowOptions::FewestSteps);
    EXPECT_EQ(made.Map.Points() == made.Result.Before, isLeftOut);
    for (std::int64_t ring = 0; ring < made.Map.Rings(); ++ring)
    {
      EXPECT_GT(made.Map.AreaOf(ring), 0.0) << ring;
    }
  }
}

// A figure of eight has its area by the even-odd rule, and gets its share.
TEST(Cartogram, CrossingOutline)
{
  RegionMap map;
  addRing(map, 0, rectangle(5, 0, 8, 3));
  addRing(map, 1, { { 0, 0 }, { 3, 3 }, { 3, 0 }, { 0, 3 } });
  map.FindHoles();
  const std::vector<double> masses{ 1.0, 2.0 };
  const Made made = make(std::move(map), masses, coarse());
  const std::vector<double> areas = made.Map.Areas(2);
  EXPECT_NEAR(areas[1] / areas[0], 2.0, 0.03);
  EXPECT_NEAR(made.Before[1] / made.Before[0], 0.5, 1e-12);
  EXPECT_EQ(made.Result.Folded, 0);
}

// Squares in the same place have one area, whatever their masses: no pass can change that, and few
// are made.
TEST(Cartogram, RegionsOnEachOther)
{
  for (const double mass : { 2.0, 1.0 })
  {
    RegionMap map;
    addRing(map, 0, rectangle(0, 0, 4, 4));
    addRing(map, 1, rectangle(0, 0, 4, 4));
    addRing(map, 2, rectangle(4, 0, 8, 4));
    map.FindHoles();
    const std::vector<double> masses{ 1.0, mass, 1.0 };
    const Made made = make(std::move(map), masses, coarse());
    const std::vector<double> areas = made.Map.Areas(3);
    EXPECT_LE(made.Result.Passes.size(), 3U);
    EXPECT_NEAR(made.Result.Overlap, 1.0 / 3.0, 0.01);
    EXPECT_NEAR(made.Result.Overlaps[1], 1.0, 0.02);
    EXPECT_EQ(made.Result.Overlaps[2], 0.0);
    EXPECT_DOUBLE_EQ(areas[0], areas[1]);
    EXPECT_TRUE(made.Result.OutOfReach.empty());
    // The land keeps its area.
    EXPECT_NEAR((areas[0] + areas[2]) / (made.Before[0] + made.Before[2]), 1.0, 0.02);
    if (mass == 1.0) // as a map has a region twice
    {
      expectRight(made, masses, 0.01);
    }
  }
}

// Passes whose raster foretells that areas are missed take no more steps than usual: they took
// thousands.
TEST(Cartogram, DiscsOnEachOther)
{
  RegionMap map;
  std::vector<double> masses;
  std::mt19937_64 engine(1);
  for (std::int32_t i = 0; i < 40; ++i)
  {
    const Point<2> centre{ uniformNumber(engine), uniformNumber(engine) };
    std::vector<Point<2>> disc;
    for (int corner = 0; corner < 32; ++corner)
    {
      const double angle = corner * std::acos(-1.0) / 16.0;
      disc.push_back({ centre[0] + 0.3 * std::cos(angle), centre[1] + 0.3 * std::sin(angle) });
    }
    addRing(map, i, disc);
    masses.push_back(1.0 + i);
  }
  map.FindHoles();
  const Made made = make(std::move(map), masses, coarse());
  int missed = 0;
  for (const CartogramPass& pass : made.Result.Passes)
  {
    const bool isMissed = pass.PredictedError > coarse().Tolerance;
    missed += isMissed ? 1 : 0;
    EXPECT_TRUE(!isMissed || pass.NumberOfSteps <= 256) << pass.NumberOfSteps;
  }
  EXPECT_GT(missed, 0);
}

// Contours, each in the one before.
TEST(Cartogram, NestedRegions)
{
  RegionMap map;
  std::vector<double> masses;
  for (std::int32_t i = 0; i < 25; ++i)
  {
    const double half = 500.0 + 20.0 * i;
    addRing(map, i, rectangle(-half, -half, half, half));
    masses.push_back(1.0 + i);
  }
  map.FindHoles();
  const Made made = make(std::move(map), masses, coarse());
  EXPECT_GT(made.Result.Overlap, 0.9);
  EXPECT_LE(made.Result.Passes.size(), 10U);
  for (std::int64_t ring = 0; ring < made.Map.Rings(); ++ring)
  {
    EXPECT_GT(made.Map.AreaOf(ring), 0.0);
  }
}

TEST(Cartogram, Cancelled)
{
  Context context;
  context.IsCancelled = []() { return true; };
  EXPECT_THROW(make(squares(4), masses16(9.0), coarse(), nullptr, context), Cancelled);
}

TEST(RaiseMasses, ToTheMinimumShare)
{
  std::vector<double> masses{ 1.0, 2.0, 97.0, 1000.0 };
  EXPECT_EQ(raiseMasses(masses, 0.1), 3);
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(masses[i] / total, 0.1, 1e-12);
  }
  EXPECT_EQ(masses[3], 1000.0);
  std::vector<double> same{ 1.0, 2.0, 6.0 };
  EXPECT_EQ(raiseMasses(same, 0.4), 2);
  EXPECT_EQ(same, (std::vector<double>{ 3.0, 3.0, 3.0 }));
  std::vector<double> large{ 1.0, 2.0 };
  EXPECT_EQ(raiseMasses(large, 0.2), 0);
  EXPECT_EQ(large, (std::vector<double>{ 1.0, 2.0 }));
}

} // namespace
} // namespace RectifiedTransport
