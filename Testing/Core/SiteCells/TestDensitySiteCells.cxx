// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites with equal masses of a density: those of the flow and those of least cost, and
// what is measured of them.
#include "Core/SiteCells/DensitySiteCells.h"
#include "Core/SiteCells/PowerSiteCells.h"
#include "Core/SiteCells/SiteCellStatistics.h"
#include "Core/SiteCells/SiteCells.h"

#include "RecordingContext.h"
#include "TestFlow.h"
#include "TestGrid.h"
#include "TestMasses.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

namespace RectifiedTransport
{
namespace
{

using Labels = std::vector<std::int64_t>;

template <int Dimension>
Labels labelsOf(const TestDensity<Dimension>& density, const ImageGrid& grid,
  const Points<3>& sites, const FlowOptions& options = {}, const Context& context = Context())
{
  const RectifiedFlow<Dimension> flow(density.Source(), context);
  const DensitySiteCells<Dimension> cells(sites, grid, density.Source(), flow.Total(), context);
  Labels labels(static_cast<std::size_t>(grid.NumberOfCells()), -7);
  cells.Label(flow, labels.data(), options, context);
  return labels;
}

// Any sites have equal shares to the heaviest pixel: those that are distributed like the density,
// and those that are not.
template <int Dimension>
void expectEqualShares(const TestDensity<Dimension>& density,
  const NotDeduced<GridSize<Dimension>>& pixels, std::size_t count, const std::string& what)
{
  const ImageGrid grid = pixelsOn<Dimension>(density.Size, pixels);
  const PixelMasses<Dimension> masses = massesOf<Dimension>(density, pixels);
  const auto even = randomPoints<Dimension>(density.Size, count, 3);
  for (const bool isEven : { true, false })
  {
    const auto places = isEven ? even : runForward<Dimension>(makeFlow(density), even);
    const Labels labels = labelsOf<Dimension>(density, grid, inSpace<Dimension>(places));
    const auto sites = static_cast<std::int64_t>(count);
    const Shares shares = sharesOf<Dimension>(masses, labels, sites);
    EXPECT_LE(shares.Deviation(), static_cast<double>(masses.Heaviest()))
      << what << (isEven ? ", even" : ", like the density");
  }
}

TEST(DensitySiteCells, EqualShares)
{
  expectEqualShares<2>(twoGaussians<2>({ 64, 64 }), { 96, 96 }, 60, "Gaussians");
  expectEqualShares<2>(twoGaussians<2>({ 100, 80 }), { 60, 48 }, 60, "Gaussians, coarse pixels");
  expectEqualShares<2>(discWithHole<2>({ 64, 64 }), { 96, 96 }, 50, "disc with a hole");
  expectEqualShares<2>(checker<2>({ 64, 64 }, 8), { 64, 64 }, 90, "checkerboard");
  expectEqualShares<2>(randomCells<2>({ 64, 64 }, 0.0), { 96, 96 }, 200, "noise");
  expectEqualShares<3>(twoGaussians<3>({ 20, 20, 20 }), { 24, 24, 24 }, 40, "Gaussians in space");
  expectEqualShares<3>(discWithHole<3>({ 20, 20, 20 }), { 24, 24, 24 }, 40, "ball with a hole");
  expectEqualShares<1>(twoGaussians<1>({ 200 }), { 500 }, 30, "Gaussians on a line");
}

// In 1D cells are intervals in the order of the sites. Where there is no mass is no cell.
TEST(DensitySiteCells, IntervalsInOneDimension)
{
  TestDensity<1> density = uniformDensity<1>({ 90 }, 0.0);
  for (std::size_t i = 30; i < 70; ++i)
  {
    density.Values[i] = i < 50 ? 3.0 : 1.0;
  }
  const Points<3> sites = { { 80.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0 } };
  const Labels labels = labelsOf<1>(density, pixelsOn<1>({ 90 }, { 180 }), sites);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    // Half of the mass of 80 is at 30 + 40 / 3.
    const double middle = 0.5 * static_cast<double>(i) + 0.25;
    const bool hasMass = middle > 30.0 && middle < 70.0;
    EXPECT_EQ(labels[i], !hasMass ? -1 : middle < 30.0 + 40.0 / 3.0 ? 1 : 0) << i;
  }
}

// The masses, in shares of a site, of all parts of cells that are not connected with the largest
// part of their cell.
std::vector<double> cutOffParts(const TestDensity<2>& density, std::size_t count)
{
  const GridSize<2>& size = density.Size;
  const ImageGrid grid = pixelsOn<2>(size, size);
  const PixelMasses<2> masses = massesOf<2>(density, size);
  const auto places =
    runForward<2>(makeFlow(density), randomPoints<2>(size, count, 3), FlowOptions());
  const Labels labels = labelsOf<2>(density, grid, inSpace<2>(places));
  std::vector<std::vector<std::int64_t>> parts(count);
  Labels seen(labels.size(), 0);
  for (std::size_t begin = 0; begin < labels.size(); ++begin)
  {
    if (seen[begin] || labels[begin] < 0)
    {
      continue;
    }
    std::vector<std::int64_t> stack{ static_cast<std::int64_t>(begin) };
    seen[begin] = 1;
    std::int64_t mass = 0;
    while (!stack.empty())
    {
      const std::int64_t pixel = stack.back();
      stack.pop_back();
      mass += masses[pixel];
      const std::int64_t x = pixel % size[0];
      const std::int64_t y = pixel / size[0];
      for (const auto& [i, j] : { std::pair{ x - 1, y }, { x + 1, y }, { x, y - 1 }, { x, y + 1 } })
      {
        const std::int64_t other = j * size[0] + i;
        if (i >= 0 && j >= 0 && i < size[0] && j < size[1] && !seen[other] &&
          labels[other] == labels[begin])
        {
          seen[other] = 1;
          stack.push_back(other);
        }
      }
    }
    parts[labels[begin]].push_back(mass);
  }
  const double share = static_cast<double>(masses.Total()) / static_cast<double>(count);
  std::vector<double> shares;
  for (auto& ofSite : parts)
  {
    std::sort(ofSite.begin(), ofSite.end());
    for (std::size_t i = 0; i + 1 < ofSite.size(); ++i)
    {
      shares.push_back(static_cast<double>(ofSite[i]) / share);
    }
  }
  return shares;
}

// Where the density has no gaps, cells of a smooth one are in one piece. Those of a patchy one may
// be in large pieces, but have no specks.
TEST(DensitySiteCells, NoSpecks)
{
  EXPECT_TRUE(cutOffParts(twoGaussians<2>({ 128, 128 }), 100).empty());
  TestDensity<2> patchy = randomCells<2>({ 128, 128 }, 0.0);
  for (double& value : patchy.Values)
  {
    value = std::pow(value, 8.0) + 1e-6;
  }
  for (const std::size_t count : { 50, 68 })
  {
    for (const double part : cutOffParts(patchy, count))
    {
      EXPECT_GT(part, 0.1) << count;
    }
  }
}

// A constant density has the cells of the uniform measure: both flows are the same where the flow
// of the density leaves all where it is, and only pixels on the borders are given to equal masses
// in another order.
TEST(DensitySiteCells, ConstantDensityIsTheUniformMeasure)
{
  const GridSize<2> size{ 128, 96 };
  const ImageGrid grid = makeGrid<2>(size, { 1.0, 1.0, 1.0 });
  const Points<3> sites = inSpace<2>(randomPoints<2>(size, 40, 8));
  const Labels uniform = labelSiteCells<2>(sites, grid);
  const Labels labels =
    labelsOf<2>(uniformDensity<2>({ 32, 24 }, 5.0), makeGrid<2>(size, { 1.0, 1.0, 1.0 }), sites);
  const std::int64_t same =
    std::inner_product(labels.begin(), labels.end(), uniform.begin(), std::int64_t{ 0 },
      std::plus<>(), [](std::int64_t a, std::int64_t b) { return a == b ? 1 : 0; });
  EXPECT_GT(static_cast<double>(same), 0.98 * static_cast<double>(labels.size()));
}

// The mass of the left half is three times that of the right one: of four sites in a row three are
// in the left half.
TEST(DensitySiteCells, FollowTheMass)
{
  TestDensity<2> density = uniformDensity<2>({ 64, 16 });
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    density.Values[i] = i % 64 < 32 ? 3.0 : 1.0;
  }
  const Points<3> sites = { { 5.3, 8.0, 0.0 }, { 16.0, 8.0, 0.0 }, { 26.7, 8.0, 0.0 },
    { 48.0, 8.0, 0.0 } };
  const Labels labels = labelsOf<2>(density, pixelsOn<2>({ 64, 16 }, { 192, 48 }), sites);
  int differences = 0;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    const std::size_t x = i % 192;
    differences += labels[i] == (x < 32 ? 0 : x < 64 ? 1 : x < 96 ? 2 : 3) ? 0 : 1;
  }
  EXPECT_LT(differences, 0.02 * static_cast<double>(labels.size()));
}

// Sites of one point, many in one heavy pixel, outside, in empty regions; one site.
TEST(DensitySiteCells, SpecialSites)
{
  TestDensity<2> density = discWithHole<2>({ 60, 60 });
  density.Values[static_cast<std::size_t>(cellIndex<2>({ 12, 30 }, { 60, 60 }))] = 40.0;
  const GridSize<2> size{ 60, 60 };
  const ImageGrid grid = pixelsOn<2>(size, size);
  const PixelMasses<2> masses = massesOf<2>(density, size);
  Points<2> places = runForward<2>(makeFlow(density), randomPoints<2>(size, 30, 2));
  std::fill(places.begin(), places.begin() + 5, places[5]);
  places[10] = { 0.5, 0.5 };
  places[11] = { -30.0, 70.0 };
  places[12] = { 30.0, 30.0 }; // in the hole
  std::fill(places.begin() + 13, places.begin() + 17, Point<2>{ 12.2, 30.7 });
  const Points<3> sites = inSpace<2>(places);
  const RectifiedFlow<2> flow(density.Source());
  const DensitySiteCells<2> cells(sites, grid, density.Source(), flow.Total());
  EXPECT_EQ(cells.NumberOutside(), 1);
  Labels labels(3600, -7);
  cells.Label(flow, labels.data());
  const Shares shares = sharesOf<2>(masses, labels, 30);
  EXPECT_LE(shares.Deviation(), static_cast<double>(masses.Heaviest()));
  EXPECT_GT(shares.Least, 0.0);
  for (const Points<3>& one : { Points<3>{ sites[0] }, Points<3>{ sites[11] } })
  {
    const Labels all = labelsOf<2>(density, grid, one);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      EXPECT_EQ(all[i], masses[static_cast<std::int64_t>(i)] > 0 ? 0 : -1) << i;
    }
  }
  // All of one point: the whole is bisected.
  const Labels parts = labelsOf<2>(density, grid, Points<3>(7, sites[0]));
  const Shares equal = sharesOf<2>(masses, parts, 7);
  EXPECT_LE(equal.Deviation(), static_cast<double>(masses.Heaviest()));
}

TEST(DensitySiteCells, NeedAPixelWithMassForEachSite)
{
  const TestDensity<2> density = dirac<2>({ 6, 6 }, { 2, 3 });
  const ImageGrid grid = pixelsOn<2>({ 6, 6 }, { 12, 12 });
  const Points<3> four(4, Point<3>{ 1.0, 1.0, 0.0 });
  const Labels labels = labelsOf<2>(density, grid, four);
  const Shares shares = sharesOf<2>(massesOf<2>(density, { 12, 12 }), labels, 4);
  EXPECT_EQ(shares.Least, shares.Most);
  try
  {
    labelsOf<2>(density, grid, Points<3>(5, four[0]));
    FAIL() << "five sites on four pixels";
  }
  catch (const TooFewPixels& few)
  {
    EXPECT_EQ(few.PixelsWithMass(), 4);
    EXPECT_STREQ(
      few.what(), "There are 5 sites and 4 pixels with mass; there must be one for each");
  }
}

TEST(DensitySiteCells, ThreadsDoNotMatter)
{
  const TestDensity<2> density = twoGaussians<2>({ 90, 70 });
  const ImageGrid grid = pixelsOn<2>({ 90, 70 }, { 120, 80 });
  const Points<3> sites = inSpace<2>(randomPoints<2>({ 90, 70 }, 50, 12));
  const Labels serial = labelsOf<2>(density, grid, sites, {}, SerialExecutor());
  for (const int threads : { 1, 2, 3 })
  {
    EXPECT_EQ(labelsOf<2>(density, grid, sites, {}, ThreadsExecutor(threads)), serial) << threads;
  }
}

TEST(DensitySiteCells, CanBeCancelled)
{
  const TestDensity<2> density = twoGaussians<2>({ 90, 70 });
  const ImageGrid grid = pixelsOn<2>({ 90, 70 }, { 360, 280 });
  const Points<3> sites = inSpace<2>(randomPoints<2>({ 90, 70 }, 50, 12));
  const RectifiedFlow<2> flow(density.Source());
  Labels labels(100800);
  const OpenMPExecutor threads;
  RecordingContext all(threads);
  {
    const DensitySiteCells<2> cells(sites, grid, density.Source(), flow.Total(), all.Context());
    all.ExpectReported(0.0, 1.0);
    all.Queries = 0;
    cells.Label(flow, labels.data(), {}, all.Context());
    EXPECT_TRUE(std::is_sorted(all.Reported.begin(), all.Reported.end()));
    EXPECT_GT(all.Reported.back(), 0.99); // no pixels are left to be divided
  }
  const DensitySiteCells<2> cells(sites, grid, density.Source(), flow.Total());
  for (const double part : { 0.0, 0.3, 0.7, 0.9 })
  {
    RecordingContext some(threads);
    some.MaximumQueries = static_cast<int>(part * all.Queries);
    EXPECT_THROW(cells.Label(flow, labels.data(), {}, some.Context()), Cancelled) << part;
  }
}

struct Figures
{
  explicit Figures(std::size_t count)
    : Mass(count)
    , Centroid(count)
    , Cost(count)
  {
  }
  SiteCellStatistics Arrays() { return { this->Mass.data(), this->Centroid, this->Cost.data() }; }

  std::vector<double> Mass;
  Points<3> Centroid;
  std::vector<double> Cost;
  double Total = 0.0;
};

// Of labels that need not be those of the flow.
TEST(DensitySiteCells, StatisticsWeighPixelsByMass)
{
  const TestDensity<2> density = randomCells<2>({ 6, 4 }, 0.0);
  const GridSize<2> size{ 12, 4 };
  const ImageGrid grid = makeGrid<2>(size, { 0.5, 2.0, 1.0 }, { 3.0, 1.0, 7.0 });
  const Points<3> sites = { { 4.0, 2.0, 7.0 }, { 8.0, 5.0, 7.5 }, { -9.0, 2.0, 7.0 } };
  const double all = std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
  const DensitySiteCells<2> cells(sites, grid, density.Source(), all);
  EXPECT_EQ(cells.NumberOutside(), 2);
  Labels labels(48);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    labels[i] = i % 5 < 2 ? 0 : 1; // the third has none
  }
  const PixelMasses<2> masses = massesOf<2>(density, size);
  Figures expected(3);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    const double share = static_cast<double>(masses[static_cast<std::int64_t>(i)]) /
      static_cast<double>(masses.Total());
    const auto site = static_cast<std::size_t>(labels[i]);
    const Point<3> x = { 3.25 + 0.5 * static_cast<double>(i % 12),
      2.0 + 2.0 * static_cast<double>(i / 12), 7.0 };
    double distance = 0.0;
    for (std::size_t r = 0; r < 3; ++r)
    {
      expected.Centroid[site][r] += share * x[r];
      distance += std::abs(x[r] - sites[site][r]);
    }
    expected.Mass[site] += share;
    expected.Cost[site] += share * std::pow(distance, 3.0);
  }
  Figures found(3);
  found.Total = measureSiteCells<2>(cells, labels.data(), 60.0, { 1.0, 3.0 }, found.Arrays());
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_NEAR(found.Mass[i], 60.0 * expected.Mass[i], 1e-13);
    EXPECT_NEAR(found.Cost[i], expected.Cost[i], 1e-12 * expected.Cost[i]);
    for (std::size_t r = 0; r < 3; ++r)
    {
      EXPECT_NEAR(found.Centroid[i][r], expected.Centroid[i][r] / expected.Mass[i], 1e-13);
    }
  }
  EXPECT_NEAR(found.Mass[0] + found.Mass[1], 60.0, 1e-12);
  EXPECT_NEAR(found.Total, expected.Cost[0] + expected.Cost[1], 1e-12 * found.Total);
  // A cell without mass is at its site, moved into the domain.
  EXPECT_EQ(found.Mass[2], 0.0);
  EXPECT_EQ(found.Cost[2], 0.0);
  EXPECT_EQ(found.Centroid[2], (Point<3>{ 3.0, 2.0, 7.0 }));
}

double sumOf(const TestDensity<2>& density)
{
  return std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
}

// Polygons of exactly equal mass, whose integrals are those of fine pixels, and whose cost is below
// that of the flow's cells.
TEST(PowerSiteCells, OfADensity)
{
  const TestDensity<2> density = twoGaussians<2>({ 64, 48 });
  const ImageGrid fine = pixelsOn<2>({ 64, 48 }, { 640, 480 });
  const Points<2> even = randomPoints<2>({ 64, 48 }, 60, 4);
  for (const Points<2>& places : { even, runForward<2>(makeFlow(density), even) })
  {
    const Points<3> sites = inSpace<2>(places);
    const PowerSiteCells cells(sites, fine, density.Source(), 12.0);
    Figures figures(60);
    figures.Total = cells.Measure(figures.Arrays());
    Labels labels(static_cast<std::size_t>(fine.NumberOfCells()));
    cells.Label(labels.data());
    const DensitySiteCells<2> pixels(sites, fine, density.Source(), sumOf(density));
    Figures byPixels(60);
    byPixels.Total = measureSiteCells<2>(pixels, labels.data(), 12.0, {}, byPixels.Arrays());
    for (std::size_t i = 0; i < 60; ++i)
    {
      EXPECT_NEAR(figures.Mass[i], 0.2, 2e-7);
      EXPECT_NEAR(byPixels.Mass[i], 0.2, 0.02);
      for (std::size_t r = 0; r < 2; ++r)
      {
        EXPECT_NEAR(figures.Centroid[i][r], byPixels.Centroid[i][r], 0.1);
      }
    }
    EXPECT_NEAR(byPixels.Total, figures.Total, 2e-3 * figures.Total);
    const ImageGrid coarse = pixelsOn<2>({ 64, 48 }, { 128, 96 });
    const Labels flow = labelsOf<2>(density, coarse, sites);
    const DensitySiteCells<2> flowCells(sites, coarse, density.Source(), sumOf(density));
    Figures ofFlow(60);
    ofFlow.Total = measureSiteCells<2>(flowCells, flow.data(), 12.0, {}, ofFlow.Arrays());
    EXPECT_GT(ofFlow.Total, 1.01 * figures.Total);
    EXPECT_LT(ofFlow.Total, 1.6 * figures.Total);
  }
}

TEST(PowerSiteCells, OfAConstantDensityAreThoseOfTheUniformMeasure)
{
  const ImageGrid grid = makeGrid<2>({ 60, 40 }, { 0.5, 1.5, 1.0 });
  const Points<3> sites = inSpace<2>(randomPoints<2>({ 30, 60 }, 80, 6));
  const PowerSiteCells uniform(sites, grid);
  const TestDensity<2> density = uniformDensity<2>({ 7, 9 }, 3.0);
  const PowerSiteCells constant(sites, grid, density.Source(), 1800.0);
  Figures a(80);
  Figures b(80);
  a.Total = uniform.Measure(a.Arrays());
  b.Total = constant.Measure(b.Arrays());
  EXPECT_NEAR(a.Total, b.Total, 1e-6 * a.Total);
  for (std::size_t i = 0; i < 80; ++i)
  {
    EXPECT_NEAR(a.Mass[i], b.Mass[i], 1e-6 * a.Mass[i]);
    EXPECT_NEAR(a.Cost[i], b.Cost[i], 1e-5 * a.Cost[i]);
    for (std::size_t r = 0; r < 2; ++r)
    {
      EXPECT_NEAR(a.Centroid[i][r], b.Centroid[i][r], 1e-5);
    }
  }
}

// Regions without mass, with all or no sites in them, and sites outside.
TEST(PowerSiteCells, OfADensityWithEmptyRegions)
{
  const TestDensity<2> density = discWithHole<2>({ 64, 64 });
  const ImageGrid grid = pixelsOn<2>({ 64, 64 }, { 64, 64 });
  Points<2> places = randomPoints<2>({ 64, 64 }, 50, 5);
  places[3] = { -20.0, 90.0 };
  for (const bool inCorner : { false, true })
  {
    for (Point<2>& place : places)
    {
      place = inCorner ? Point<2>{ 0.1 * place[0], 0.1 * place[1] } : place;
    }
    const PowerSiteCells cells(inSpace<2>(places), grid, density.Source(), 1.0);
    Figures figures(50);
    figures.Total = cells.Measure(figures.Arrays());
    for (const double mass : figures.Mass)
    {
      EXPECT_NEAR(mass, 0.02, 2e-8) << inCorner;
    }
  }
}

TEST(PowerSiteCells, OfWhatIsNoDensity)
{
  const ImageGrid grid = makeGrid<2>({ 8, 8 }, { 1.0, 1.0, 1.0 });
  const Points<3> sites = { { 1.0, 1.0, 0.0 }, { 5.0, 5.0, 0.0 } };
  TestDensity<2> density = uniformDensity<2>({ 8, 8 });
  density.Values[9] = -1.0;
  EXPECT_THROW(PowerSiteCells(sites, grid, density.Source(), 1.0), InvalidDensity);
  density.Values[9] = std::nan("");
  EXPECT_THROW(PowerSiteCells(sites, grid, density.Source(), 1.0), InvalidDensity);
  EXPECT_THROW(
    PowerSiteCells(sites, grid, uniformDensity<2>({ 8, 8 }, 0.0).Source(), 1.0), InvalidDensity);
}

// Points that are those of a lattice come to the cells of the lattice's samples.
TEST(RectifiedFlow, ForwardToCellsIsThatOfALattice)
{
  const GridSize<2> size{ 50, 40 };
  const SiteDensity<2> sites(size, randomPoints<2>(size, 20, 5));
  const RectifiedFlow<2> flow(sites);
  const Points<2> points = latticePoints<2>(size, size);
  Labels lattice(points.size());
  Labels cells(points.size());
  flow.ForwardToCells(FlowSeeds<2>::Lattice(size), lattice.data());
  const FlowReport report = flow.ForwardToCells(points, cells.data());
  EXPECT_EQ(cells, lattice);
  EXPECT_GT(report.Evaluations, 0);
  flow.ForwardToCells(ConstPointSpan<2>(), cells.data()); // no points are no error
}

} // namespace
} // namespace RectifiedTransport
