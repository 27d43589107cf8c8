// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites: which pixel comes to which site, cells made equal, cells that sites share.
#include "Core/SiteCells/EqualMasses/EqualizeSiteCells.h"
#include "Core/SiteCells/EqualMasses/SplitSharedPixels.h"
#include "Core/SiteCells/SiteDensity.h"
#include "Oracle.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace RectifiedTransport
{
namespace
{

using Labels = std::vector<std::int64_t>;

template <int Dimension>
SiteDensity<Dimension> pixelsOf(
  const GridSize<Dimension>& size, const NotDeduced<Points<Dimension>>& sites)
{
  return SiteDensity<Dimension>(size, sites);
}

template <int Dimension>
Labels flowToSites(const SiteDensity<Dimension>& sites, const FlowOptions& options = {},
  const Context& context = Context())
{
  const RectifiedFlow<Dimension> flow(sites, context);
  Labels labels(cellCount<Dimension>(sites.Size()));
  flow.ForwardToCells(FlowSeeds<Dimension>::Lattice(sites.Size()), labels.data(), options, context);
  for (std::int64_t& label : labels)
  {
    const std::int64_t k = sites.Find(label);
    EXPECT_TRUE(k < sites.NumberOfPixels() && sites.Pixel(k) == label) << label;
    label = k;
  }
  return labels;
}

std::vector<std::int64_t> countLabels(const Labels& labels, std::int64_t count)
{
  std::vector<std::int64_t> counts(count, 0);
  for (const std::int64_t label : labels)
  {
    ++counts.at(label);
  }
  return counts;
}

// As many pixels for each of the sites, or one more.
template <int Dimension>
void expectBalanced(const SiteDensity<Dimension>& sites, Labels labels, const std::string& what)
{
  equalizeSiteCells<Dimension>(sites, evenPoint<Dimension>(1.0), labels.data());
  const auto each = static_cast<std::int64_t>(labels.size()) / sites.NumberOfSites();
  const auto counts = countLabels(labels, sites.NumberOfPixels());
  for (std::int64_t k = 0; k < sites.NumberOfPixels(); ++k)
  {
    EXPECT_GE(counts[k], each * sites.SitesIn(k)) << what << ", cell " << k;
    EXPECT_LE(counts[k], (each + 1) * sites.SitesIn(k)) << what << ", cell " << k;
  }
}

TEST(SiteCells, PixelsOfSites)
{
  const auto pixels =
    pixelsOf<2>({ 4, 3 }, { { 3.5, 2.5 }, { 0.2, 1.0 }, { 3.9, 2.1 }, { 4.0, 3.0 }, { 1.0, 0.0 } });
  ASSERT_EQ(pixels.NumberOfPixels(), 3);
  ASSERT_EQ(pixels.NumberOfSites(), 5);
  EXPECT_EQ(pixels.Pixel(0), 1);
  EXPECT_EQ(pixels.Pixel(1), 4);
  EXPECT_EQ(pixels.Pixel(2), 11); // with the corner of the box
  EXPECT_EQ(pixels.SitesIn(2), 3);
  EXPECT_EQ(pixels.Site(2, 0), 0);
  EXPECT_EQ(pixels.Site(2, 1), 2);
  EXPECT_EQ(pixels.Site(2, 2), 3);
  EXPECT_EQ(pixels.Find(4), 1);

  std::vector<double> row(2);
  pixels.Read(10, 2, row.data());
  EXPECT_EQ(row, (std::vector<double>{ 0.0, 3.0 }));
  pixels.Read(0, 2, row.data());
  EXPECT_EQ(row, (std::vector<double>{ 0.0, 1.0 }));
  // Cells are read across the ends of rows.
  std::vector<double> rows(6);
  pixels.Read(1, 6, rows.data());
  EXPECT_EQ(rows, (std::vector<double>{ 1.0, 0.0, 0.0, 1.0, 0.0, 0.0 }));
}

// The oracle follows pixels to the sites by itself. Those that it and the flow send to different
// sites lie on the borders.
template <int Dimension>
void expectOracle(const GridSize<Dimension>& size, std::size_t count, double share)
{
  const auto sites = pixelsOf<Dimension>(size, randomPoints<Dimension>(size, count, 11));
  const Labels labels = flowToSites(sites);
  std::vector<double> values(labels.size(), 0.0);
  for (std::int64_t k = 0; k < sites.NumberOfPixels(); ++k)
  {
    values[sites.Pixel(k)] = static_cast<double>(sites.SitesIn(k));
  }
  Points<Dimension> seeds = latticePoints<Dimension>(size, size);
  Labels chosen(seeds.size());
  std::iota(chosen.begin(), chosen.end(), std::int64_t{ 0 });
  std::mt19937_64 engine(3);
  std::shuffle(chosen.begin(), chosen.end(), engine);
  chosen.resize(300);
  Points<Dimension> starts;
  for (const std::int64_t pixel : chosen)
  {
    starts.push_back(seeds[pixel]);
  }
  const Points<Dimension> ends = Oracle<Dimension>(values, size).Forward(starts);
  int different = 0;
  for (std::size_t i = 0; i < starts.size(); ++i)
  {
    GridSize<Dimension> cell;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      cell[axis] = std::min(static_cast<std::int64_t>(ends[i][axis]), size[axis] - 1);
    }
    const std::int64_t pixel = cellIndex<Dimension>(cell, size);
    different += sites.Pixel(labels[chosen[i]]) == pixel ? 0 : 1;
  }
  EXPECT_LE(different, share * static_cast<double>(starts.size()));
}

TEST(SiteCells, OracleSendsPixelsToTheSameSites)
{
  expectOracle<1>({ 500 }, 20, 0.03);
  expectOracle<2>({ 128, 96 }, 40, 0.05);
  expectOracle<3>({ 24, 20, 16 }, 30, 0.05);
}

// In 1D the flow keeps the order of the pixels, so that cells are intervals of equal length.
TEST(SiteCells, IntervalsInOneDimension)
{
  const GridSize<1> size{ 1000 };
  const Points<1> places{ { 900.5 }, { 20.5 }, { 30.5 }, { 500.5 } };
  const auto sites = pixelsOf<1>(size, places);
  Labels labels = flowToSites(sites);
  EXPECT_TRUE(std::is_sorted(labels.begin(), labels.end()));
  const auto counts = countLabels(labels, 4);
  for (const std::int64_t count : counts)
  {
    EXPECT_NEAR(static_cast<double>(count), 250.0, 2.0);
  }
  expectBalanced<1>(sites, labels, "intervals");
}

TEST(SiteCells, FlowIsTheSameOnAnyExecutor)
{
  const GridSize<2> size{ 90, 70 };
  const auto sites = pixelsOf<2>(size, randomPoints<2>(size, 25));
  for (const Integrator method : AllIntegrators)
  {
    const FlowOptions options = steps(16, method);
    EXPECT_EQ(flowToSites(sites, options, SerialExecutor()), flowToSites(sites, options))
      << nameOf(method);
  }
}

// What the flow alone makes is equal to a few pixels a border.
TEST(SiteCells, FlowGivesNearlyEqualCells)
{
  const GridSize<2> size{ 256, 256 };
  const auto sites = pixelsOf<2>(size, randomPoints<2>(size, 64, 5));
  ASSERT_EQ(sites.NumberOfPixels(), 64);
  for (const FlowOptions& options : { steps(32), steps(4), steps(200), steps(32, Integrator::Euler),
         steps(32, Integrator::RungeKutta4) })
  {
    const auto counts = countLabels(flowToSites(sites, options), 64);
    const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
    const double tolerance = options.Integrator == Integrator::Euler ? 120.0 : 90.0;
    EXPECT_NEAR(static_cast<double>(*least), 1024.0, tolerance) << nameOf(options.Integrator);
    EXPECT_NEAR(static_cast<double>(*most), 1024.0, tolerance) << nameOf(options.Integrator);
  }
}

// Boxes at nodes give cells nearly as equal, of which every fiftieth pixel is another's.
TEST(SiteCells, NearestLookupFindsSitesToo)
{
  const GridSize<2> size{ 128, 128 };
  const auto sites = pixelsOf<2>(size, randomPoints<2>(size, 16, 5));
  FlowOptions options;
  options.Lookup = TableLookup::Nearest;
  const Labels labels = flowToSites(sites, options);
  const Labels exact = flowToSites(sites);
  const std::int64_t same =
    std::inner_product(labels.begin(), labels.end(), exact.begin(), std::int64_t{ 0 },
      std::plus<>(), [](std::int64_t a, std::int64_t b) { return a == b ? 1 : 0; });
  EXPECT_NEAR(static_cast<double>(same) / static_cast<double>(labels.size()), 0.98, 0.008);
  for (const std::int64_t count : countLabels(labels, 16))
  {
    EXPECT_NEAR(static_cast<double>(count), 1024.0, 30.0);
  }
}

template <int Dimension>
void expectAnythingIsBalanced(const GridSize<Dimension>& size, std::size_t count)
{
  Points<Dimension> places = randomPoints<Dimension>(size, count, 2);
  places.push_back(places.front()); // two sites in one pixel
  const auto sites = pixelsOf<Dimension>(size, places);
  const std::string what = std::to_string(Dimension) + "D, " + std::to_string(count) + " sites";
  expectBalanced<Dimension>(sites, flowToSites(sites), what);

  Labels one(cellCount<Dimension>(size), sites.NumberOfPixels() - 1);
  expectBalanced<Dimension>(sites, one, what + ", all pixels to one");

  std::mt19937_64 engine(9);
  Labels noise(one.size());
  for (std::int64_t& label : noise)
  {
    label =
      static_cast<std::int64_t>(engine() % static_cast<std::uint64_t>(sites.NumberOfPixels()));
  }
  expectBalanced<Dimension>(sites, noise, what + ", noise");
}

TEST(SiteCells, AnyCellsAreBalanced)
{
  expectAnythingIsBalanced<1>({ 101 }, 7);
  expectAnythingIsBalanced<2>({ 40, 30 }, 20);
  expectAnythingIsBalanced<2>({ 40, 30 }, 300);
  expectAnythingIsBalanced<2>({ 40, 1 }, 5);
  expectAnythingIsBalanced<3>({ 12, 10, 9 }, 30);
}

// On a line one face is between two cells: they must not move by one pixel a round.
TEST(SiteCells, FarBordersOnALineAreBalanced)
{
  const GridSize<1> size{ 10000 };
  const auto sites = pixelsOf<1>(size, { { 10.5 }, { 20.5 }, { 9000.5 } });
  Labels labels(10000, 1);
  equalizeSiteCells<1>(sites, { 1.0 }, labels.data());
  EXPECT_TRUE(std::is_sorted(labels.begin(), labels.end()));
  EXPECT_EQ(countLabels(labels, 3), (std::vector<std::int64_t>{ 3333, 3334, 3333 }));
}

// The nearest site is far from an equal share: borders move through many cells.
TEST(SiteCells, FarBordersInAPlaneAreBalanced)
{
  const GridSize<2> size{ 600, 400 };
  const auto sites = pixelsOf<2>(size, { { 20.5, 30.5 }, { 40.5, 370.5 }, { 580.5, 200.5 } });
  Labels labels(240000);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    labels[i] = i % 600 < 5 ? 0 : i % 600 < 10 ? 1 : 2;
  }
  expectBalanced<2>(sites, labels, "far borders");
}

// Squares of lengths may pass the range of numbers, ratios do not.
TEST(SiteCells, BalanceDoesNotDependOnTheUnit)
{
  const GridSize<2> size{ 40, 30 };
  const auto sites = pixelsOf<2>(size, randomPoints<2>(size, 20, 2));
  const Labels flow = flowToSites(sites);
  Labels usual = flow;
  equalizeSiteCells<2>(sites, { 1.0, 2.0 }, usual.data());
  for (const double unit : { 0x1p-600, 0x1p600 })
  {
    Labels labels = flow;
    equalizeSiteCells<2>(sites, { unit, 2.0 * unit }, labels.data());
    EXPECT_EQ(labels, usual) << unit;
  }
}

// Of pixels that may move, the one whose way grows least in physical length. The border is so rough
// that this is another one than on square pixels.
TEST(SiteCells, BalanceMovesTheCheapestPixel)
{
  const GridSize<2> size{ 10, 8 };
  const auto sites = pixelsOf<2>(size, { { 0.5, 0.5 }, { 9.5, 7.5 } });
  Labels labels(80);
  const std::size_t widths[] = { 8, 7, 7, 7, 7, 2, 2, 1 }; // of the first cell, one too many
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    labels[i] = i % 10 < widths[i / 10] ? 0 : 1;
  }
  const auto cheapest = [&labels](const Point<2>& spacing) {
    std::pair<double, std::size_t> best(HUGE_VAL, 0);
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      const bool touches =
        (i % 10 < 9 && labels[i + 1] == 1) || (i / 10 < 7 && labels[i + 10] == 1);
      if (labels[i] == 0 && touches)
      {
        const double x = static_cast<double>(i % 10);
        const double y = static_cast<double>(i / 10);
        const double old = std::hypot(x * spacing[0], y * spacing[1]);
        const double now = std::hypot((9.0 - x) * spacing[0], (7.0 - y) * spacing[1]);
        best = std::min(best, { now * now - old * old, i });
      }
    }
    return best.second;
  };
  const Point<2> even{ 1.0, 1.0 };
  for (const Point<2>& spacing : { Point<2>{ 1.0, 2.0 }, Point<2>{ 2.0, 1.0 } })
  {
    Labels expected = labels;
    expected[cheapest(spacing)] = 1;
    EXPECT_NE(cheapest(spacing), cheapest(even));
    Labels found = labels;
    equalizeSiteCells<2>(sites, spacing, found.data());
    EXPECT_EQ(found, expected);
  }
}

// As many sites as pixels: each pixel is a cell.
TEST(SiteCells, OnePixelForEachSite)
{
  const GridSize<2> size{ 6, 5 };
  const auto sites = pixelsOf<2>(size, latticePoints<2>(size, size));
  Labels labels(30, 4);
  equalizeSiteCells<2>(sites, { 1.0, 1.0 }, labels.data());
  EXPECT_EQ(countLabels(labels, 30), std::vector<std::int64_t>(30, 1));
}

// Cells that are equal stay as they are; a border moves where it costs least.
TEST(SiteCells, BalanceMovesOnlyWhatItMust)
{
  const GridSize<2> size{ 8, 4 };
  const auto sites = pixelsOf<2>(size, { { 1.5, 0.5 }, { 6.5, 0.5 } });
  Labels equal(32);
  for (std::size_t i = 0; i < equal.size(); ++i)
  {
    equal[i] = i % 8 < 4 ? 0 : 1;
  }
  Labels labels = equal;
  equalizeSiteCells<2>(sites, { 1.0, 1.0 }, labels.data());
  EXPECT_EQ(labels, equal);

  for (std::size_t row = 0; row < 4; ++row)
  {
    labels[8 * row + 4] = 0; // a column too many
  }
  equalizeSiteCells<2>(sites, { 1.0, 1.0 }, labels.data());
  EXPECT_EQ(labels, equal);
}

TEST(SiteCells, BalanceCanBeCancelled)
{
  const GridSize<2> size{ 512, 512 };
  const auto sites = pixelsOf<2>(size, randomPoints<2>(size, 50));
  Labels labels(cellCount<2>(size), 0);
  std::vector<double> reported;
  const OpenMPExecutor threads;
  Context context(
    threads, [&](double progress) { reported.push_back(progress); },
    [&]() { return reported.size() > 2; });
  EXPECT_THROW(equalizeSiteCells<2>(sites, { 1.0, 1.0 }, labels.data(), context), Cancelled);
  EXPECT_EQ(reported.size(), 3u);

  reported.clear();
  context.IsCancelled = []() { return false; };
  equalizeSiteCells<2>(sites, { 1.0, 1.0 }, labels.data(), context);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_LE(reported.back(), 1.0);
}

template <int Dimension>
Labels shared(const SiteDensity<Dimension>& sites, const NotDeduced<Points<Dimension>>& places,
  Labels labels, const NotDeduced<Point<Dimension>>& spacing)
{
  splitSharedPixels<Dimension>(sites, places, spacing, labels.data());
  return labels;
}

// The cell of three sites in one pixel is cut across the axis along which they differ, in their
// order; that of one site stays whole.
TEST(SiteCells, SitesInOnePixelDivideItsCell)
{
  const GridSize<2> size{ 12, 5 };
  const Points<2> places{ { 1.8, 0.5 }, { 1.2, 0.5 }, { 10.5, 3.5 }, { 1.5, 0.6 } };
  const auto sites = pixelsOf<2>(size, places);
  Labels labels(60);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    labels[i] = i % 12 < 9 ? 0 : 1;
  }
  const Labels found = shared<2>(sites, places, labels, { 1.0, 1.0 });
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const std::size_t x = i % 12;
    EXPECT_EQ(found[i], x < 3 ? 1 : x < 6 ? 3 : x < 9 ? 0 : 2) << i;
  }
}

// Two sites in one of 6 x 4 pixels have halves along x where pixels are square, and along y where
// they are tall.
void expectHalves(const Points<2>& places, double height)
{
  const auto sites = pixelsOf<2>({ 6, 4 }, places);
  const Labels square = shared<2>(sites, places, Labels(24, 0), { 1.0, 1.0 });
  const Labels tall = shared<2>(sites, places, Labels(24, 0), { 1.0, height });
  for (std::size_t i = 0; i < 24; ++i)
  {
    EXPECT_EQ(square[i], i % 6 < 3 ? 0 : 1) << i;
    EXPECT_EQ(tall[i], i / 6 < 2 ? 0 : 1) << i;
  }
}

// The axis along which sites differ most is that of the physical length, too.
TEST(SiteCells, SitesOnUnevenPixelsDivideTheirCell)
{
  expectHalves({ { 2.2, 2.3 }, { 2.8, 2.7 } }, 2.0);
}

// Sites at one point cut the cell across its longest axis, in physical length.
TEST(SiteCells, SitesAtOnePointDivideTheirCell)
{
  expectHalves({ { 2.5, 2.5 }, { 2.5, 2.5 } }, 10.0);
}

TEST(SiteCells, ManySitesInOnePixelHaveEqualParts)
{
  const GridSize<3> size{ 9, 10, 11 };
  const Points<3> places(37, Point<3>{ 4.5, 4.5, 4.5 });
  const auto sites = pixelsOf<3>(size, places);
  const auto counts = countLabels(shared<3>(sites, places, Labels(990, 0), { 1.0, 1.0, 1.0 }), 37);
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  EXPECT_GE(*least, 26);
  EXPECT_LE(*most, 27);
}

// Many sites at one point: progress is reported, and a cancellation takes effect soon.
TEST(SiteCells, SharingCanBeCancelled)
{
  const GridSize<2> size{ 1024, 1024 };
  const Points<2> places(20000, Point<2>{ 4.5, 4.5 });
  const auto sites = pixelsOf<2>(size, places);
  const OpenMPExecutor threads;
  const auto share = [&](const Context& context) {
    Labels labels(cellCount<2>(size), 0);
    splitSharedPixels<2>(sites, places, { 1.0, 1.0 }, labels.data(), context);
  };
  int asked = 0;
  EXPECT_THROW(share({ threads, {}, [&]() { return ++asked > 60; } }), Cancelled);
  EXPECT_EQ(asked, 61);

  std::vector<double> reported;
  share({ threads, [&](double progress) { reported.push_back(progress); } });
  EXPECT_GT(reported.size(), 10u);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_LE(reported.back(), 1.0);
}

} // namespace
} // namespace RectifiedTransport
