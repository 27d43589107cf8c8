// SPDX-License-Identifier: BSD-3-Clause
// Site cells of least cost: their areas, costs, labels and outlines, for sites of all kinds.
#include "Core/SiteCells/PowerSiteCells.h"

#include "Core/Parallel/Progress.h"
#include "Core/SiteCells/LabelPolygons.h"
#include "Core/SiteCells/SiteCells.h"

#include "RecordingContext.h"
#include "TestFlow.h"
#include "TestGrid.h"
#include "TestPowerCells.h"
#include "TestRefusal.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

namespace RectifiedTransport
{
namespace
{

using Labels = std::vector<std::int64_t>;

struct Figures
{
  std::vector<double> Mass;
  Points<3> Centroid;
  std::vector<double> Cost;
  double Total = 0.0;
};

Figures measure(const PowerSiteCells& cells)
{
  const auto count = static_cast<std::size_t>(cells.NumberOfSites());
  Figures figures{ std::vector<double>(count), Points<3>(count), std::vector<double>(count), 0.0 };
  figures.Total = cells.Measure({ figures.Mass.data(), figures.Centroid, figures.Cost.data() });
  return figures;
}

Labels labelsOf(
  const PowerSiteCells& cells, const ImageGrid& grid, const Context& context = Context())
{
  Labels labels(static_cast<std::size_t>(grid.NumberOfCells()), -7);
  cells.Label(labels.data(), context);
  return labels;
}

// The loops of the outlines, one for each site, in index space.
std::vector<Points<2>> loopsOf(const PowerSiteCells& cells, const ImageGrid& grid)
{
  const SiteCellOutlines<2> outlines = cells.Outlines();
  std::vector<Points<2>> loops(static_cast<std::size_t>(cells.NumberOfSites()));
  std::vector<std::int64_t> begin(loops.size(), -1);
  std::vector<std::int64_t> end(loops.size(), -1);
  for (std::size_t side = 0; side < outlines.SiteIds.size(); ++side)
  {
    const auto site = static_cast<std::size_t>(outlines.SiteIds[side]);
    const std::int64_t from = outlines.CornerIds[2 * side];
    const std::int64_t to = outlines.CornerIds[2 * side + 1];
    begin[site] = loops[site].empty() ? from : begin[site];
    EXPECT_TRUE(loops[site].empty() || end[site] == from);
    end[site] = to;
    Point<2> index;
    grid.ToIndex<2>(outlines.Points[static_cast<std::size_t>(from)].data(), index.data());
    loops[site].push_back(index);
  }
  EXPECT_EQ(begin, end);
  return loops;
}

// All that holds for any sites.
void expectCells(const PowerSiteCells& cells, const ImageGrid& grid)
{
  const Figures figures = measure(cells);
  const double area = numberOfCells<2>(grid.Size<2>()) * grid.CellMeasure();
  const double share = area / static_cast<double>(cells.NumberOfSites());
  const std::vector<Points<2>> loops = loopsOf(cells, grid);
  double all = 0.0;
  double cost = 0.0;
  for (std::size_t i = 0; i < loops.size(); ++i)
  {
    EXPECT_NEAR(figures.Mass[i], share, 1e-6 * share) << i;
    const PolygonMoments moments = fanMoments(loops[i]);
    EXPECT_NEAR(moments.Mass * grid.CellMeasure(), figures.Mass[i], 1e-9 * area) << i;
    Point<2> centroid;
    grid.ToIndex<2>(figures.Centroid[i].data(), centroid.data());
    const Point<2> lengths = grid.Lengths<2>();
    EXPECT_NEAR(moments.First[0], centroid[0] * moments.Mass, 1e-9 * area * lengths[0]);
    EXPECT_NEAR(moments.First[1], centroid[1] * moments.Mass, 1e-9 * area * lengths[1]);
    all += figures.Mass[i];
    cost += figures.Cost[i];
  }
  EXPECT_NEAR(all, area, 1e-12 * area);
  EXPECT_NEAR(cost, figures.Total, 1e-12 * cost);
  // Every pixel's centre is in the polygon of its label.
  const Labels labels = labelsOf(cells, grid);
  const std::int64_t columns = grid.Size<2>()[0];
  for (std::size_t pixel = 0; pixel < labels.size(); ++pixel)
  {
    ASSERT_GE(labels[pixel], 0);
    ASSERT_LT(labels[pixel], cells.NumberOfSites());
    const auto index = static_cast<std::int64_t>(pixel);
    const Point<2> centre = { static_cast<double>(index % columns) + 0.5,
      static_cast<double>(index / columns) + 0.5 };
    const Points<2>& loop = loops[static_cast<std::size_t>(labels[pixel])];
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      const Point<2>& a = loop[k];
      const Point<2>& b = loop[(k + 1) % loop.size()];
      const double cross = (b[0] - a[0]) * (centre[1] - a[1]) - (b[1] - a[1]) * (centre[0] - a[0]);
      EXPECT_GT(cross, -1e-8 * std::hypot(b[0] - a[0], b[1] - a[1])) << pixel;
    }
  }
}

Points<3> inPlane(const Points<2>& flat)
{
  Points<3> sites;
  for (const Point<2>& x : flat)
  {
    sites.push_back({ x[0], x[1], 0.0 });
  }
  return sites;
}

TEST(PowerSiteCells, RandomSites)
{
  const ImageGrid grid = makeGrid<2>({ 60, 40 }, { 0.5, 1.5, 1.0 });
  for (const std::size_t count : { 1u, 2u, 3u, 100u, 700u })
  {
    const Points<3> sites = inPlane(randomPoints<2>({ 30, 60 }, count, count));
    const PowerSiteCells cells(sites, grid);
    EXPECT_EQ(cells.NumberOutside(), 0);
    expectCells(cells, grid);
  }
}

TEST(PowerSiteCells, HalvesOfASquare)
{
  const ImageGrid grid = makeGrid<2>({ 5, 5 }, { 0.2, 0.2, 1.0 });
  const PowerSiteCells cells(Points<3>{ { 0.2, 0.3, 0.0 }, { 0.3, 0.3, 0.0 } }, grid);
  const Figures figures = measure(cells);
  EXPECT_NEAR(figures.Centroid[0][0], 0.25, 1e-7);
  EXPECT_NEAR(figures.Centroid[1][0], 0.75, 1e-7);
  // In the halves 1/48 + 1/12 about their centroids, and from there to the sites.
  const double spread = 1.0 / 48 + 1.0 / 12 + 0.04;
  EXPECT_NEAR(figures.Total, spread + (0.05 * 0.05 + 0.45 * 0.45) / 2, 1e-7);
  // The centres of the middle column are on the border between them.
  const Labels labels = labelsOf(cells, grid);
  for (std::size_t pixel = 0; pixel < labels.size(); ++pixel)
  {
    EXPECT_TRUE(pixel % 5 == 2 || labels[pixel] == (pixel % 5 < 2 ? 0 : 1)) << pixel;
  }
  expectCells(cells, grid);
}

// The cost at which the labels of finer and finer pixels arrive, below that of the flow's cells.
TEST(PowerSiteCells, CostIsThatOfFinePixelsAndLeast)
{
  const Points<3> sites = inPlane(randomPoints<2>({ 4, 3 }, 60, 4));
  const ImageGrid coarse = makeGrid<2>({ 80, 60 }, { 0.05, 0.05, 1.0 });
  const ImageGrid fine = makeGrid<2>({ 640, 480 }, { 0.00625, 0.00625, 1.0 });
  const double exact = measure(PowerSiteCells(sites, coarse)).Total;
  const auto pixelCost = [&](const ImageGrid& grid, const Labels& labels) {
    std::vector<double> mass(60);
    std::vector<double> cost(60);
    Points<3> centroid(60);
    const SiteCells<2> placed(sites, grid);
    return measureSiteCells<2>(placed, labels.data(), {}, { mass.data(), centroid, cost.data() });
  };
  EXPECT_NEAR(pixelCost(fine, labelsOf(PowerSiteCells(sites, fine), fine)), exact, 1e-3 * exact);
  EXPECT_GT(pixelCost(coarse, labelSiteCells<2>(sites, coarse)), 1.01 * exact);
}

// A square in space is as good as one in the plane; what is off the plane costs its distance.
TEST(PowerSiteCells, InAnyPlane)
{
  const ImageGrid flat = makeGrid<2>({ 36, 24 }, { 0.25, 0.5, 1.0 });
  const Points<2> places = randomPoints<2>({ 9, 12 }, 50, 11);
  const PowerSiteCells plain(inPlane(places), flat);
  ImageGrid::Matrix turn;
  turn << 0.6, 0.0, -0.8, 0.8, 0.0, 0.6, 0.0, -1.0, 0.0;
  const ImageGrid turned(
    { 3, 39, -2, 22, 7, 7 }, { 100.0, -3.0, 8.0 }, { 0.25, 0.5, 3.0 }, turn, false);
  Points<3> sites(places.size());
  Points<3> raised(places.size());
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    const Point<2> index = { places[i][0] / 0.25, places[i][1] / 0.5 };
    turned.ToPhysical<2>(index.data(), sites[i].data());
    for (std::size_t r = 0; r < 3; ++r)
    {
      const auto row = static_cast<Eigen::Index>(r);
      raised[i][r] = sites[i][r] + (i == 7 ? 2.5 * turn(row, 2) : 0.0);
    }
  }
  const PowerSiteCells cells(sites, turned);
  EXPECT_EQ(cells.NumberOutside(), 0);
  expectCells(cells, turned);
  EXPECT_EQ(labelsOf(cells, turned), labelsOf(plain, flat));
  EXPECT_NEAR(measure(cells).Total, measure(plain).Total, 1e-7);
  const PowerSiteCells above(raised, turned);
  EXPECT_EQ(above.NumberOutside(), 1);
  EXPECT_EQ(labelsOf(above, turned), labelsOf(plain, flat));
  EXPECT_NEAR(measure(above).Cost[7] - measure(cells).Cost[7], 2.5 * 2.5 / 50.0, 1e-7);
}

TEST(PowerSiteCells, SitesOutside)
{
  const ImageGrid grid = makeGrid<2>({ 40, 40 }, { 0.1, 0.1, 1.0 });
  Points<2> places = randomPoints<2>({ 4, 4 }, 30, 5);
  places[3] = { -2.0, 1.0 };
  places[4] = { 30.0, 70.0 };
  const PowerSiteCells some(inPlane(places), grid);
  EXPECT_EQ(some.NumberOutside(), 2);
  expectCells(some, grid);
  // It costs from where it is.
  const Figures figures = measure(some);
  EXPECT_GT(figures.Cost[4], (26.0 * 26.0 + 66.0 * 66.0) / 30.0);
  for (Point<2>& place : places)
  {
    place[0] += 100.0;
  }
  const PowerSiteCells all(inPlane(places), grid);
  EXPECT_EQ(all.NumberOutside(), 30);
  expectCells(all, grid);
  // Cells do not depend on how far away the sites are, nor on how large a pattern they make.
  const Labels labels = labelsOf(all, grid);
  for (const double scale : { 1e-6, 1e-3, 1e12 })
  {
    Points<2> copy = places;
    for (Point<2>& place : copy)
    {
      place = { 3.0 + scale * place[0], 1.0 + scale * place[1] };
    }
    const PowerSiteCells scaled(inPlane(copy), grid);
    expectCells(scaled, grid);
    const Labels found = labelsOf(scaled, grid);
    int differences = 0;
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      differences += found[i] == labels[i] ? 0 : 1;
    }
    EXPECT_LE(differences, 2) << scale;
  }
}

// However far away one site is, the others are divided as carefully; until there are no digits
// left.
TEST(PowerSiteCells, OneFarAway)
{
  const ImageGrid grid = makeGrid<2>({ 40, 40 }, { 0.1, 0.1, 1.0 });
  Points<2> places = randomPoints<2>({ 4, 4 }, 100, 15);
  std::vector<double> costs;
  for (const double distance : { 1e3, 1e5 })
  {
    places[8] = { distance, distance / 3.0 };
    const PowerSiteCells cells(inPlane(places), grid);
    expectCells(cells, grid);
    const Figures figures = measure(cells);
    double others = 0.0;
    for (std::size_t i = 0; i < figures.Cost.size(); ++i)
    {
      others += i == 8 ? 0.0 : figures.Cost[i];
    }
    costs.push_back(others);
  }
  EXPECT_LT(costs[0], 0.2);
  EXPECT_NEAR(costs[1], costs[0], 1e-3 * costs[0]);
  places[8] = { 1e12, 0.0 };
  EXPECT_THROW(PowerSiteCells(inPlane(places), grid), std::runtime_error);
}

// Sites at one point share what they would have together; the cost is of where they are.
TEST(PowerSiteCells, CoincidentSites)
{
  const ImageGrid grid = makeGrid<2>({ 40, 40 }, { 0.1, 0.1, 1.0 });
  const PowerSiteCells two(Points<3>{ { 2.0, 2.0, 0.0 }, { 2.0, 2.0, 0.0 } }, grid);
  expectCells(two, grid);
  EXPECT_NEAR(measure(two).Total, 2.0 * 16.0 / 12.0, 1e-9);

  Points<2> places = randomPoints<2>({ 4, 4 }, 50, 6);
  std::fill(places.begin() + 10, places.begin() + 25, Point<2>{ 1.0, 3.0 });
  std::fill(places.begin() + 25, places.begin() + 30, Point<2>{ 1.0, 3.0 + 1e-12 });
  expectCells(PowerSiteCells(inPlane(places), grid), grid);
  const Points<3> one(1500, Point<3>{ 1.0, 1.5, 0.0 });
  const PowerSiteCells shared(one, grid);
  expectCells(shared, grid);
  EXPECT_NEAR(measure(shared).Total, 2.0 * 16.0 / 12.0 + 1.0 + 0.25, 1e-6);
}

// Lattices put borders through the centres of pixels, strips a border into every row or column.
TEST(PowerSiteCells, BordersThroughCentres)
{
  const ImageGrid grid = makeGrid<2>({ 35, 21 }, { 1.0, 1.0, 1.0 });
  for (const GridSize<2>& perAxis :
    { GridSize<2>{ 2, 2 }, { 1, 2 }, { 10, 6 }, { 35, 21 }, { 1, 200 }, { 300, 1 }, { 70, 42 } })
  {
    const Points<3> sites = inPlane(latticePoints<2>({ 35, 21 }, perAxis));
    const PowerSiteCells cells(sites, grid);
    expectCells(cells, grid);
    const Labels labels = labelsOf(cells, grid);
    const std::set<std::int64_t> found(labels.begin(), labels.end());
    EXPECT_EQ(found.size(),
      static_cast<std::size_t>(
        std::min<std::int64_t>(perAxis[0], 35) * std::min<std::int64_t>(perAxis[1], 21)));
  }
}

// What is open between polygons goes to one of them, be it rounding or more.
TEST(PowerSiteCells, GapsAreLabelled)
{
  for (const double gap : { 1e-12, 1e-3 })
  {
    const std::vector<Point<2>> corners = { { 0, 0 }, { 4, 0 }, { 4, 1.5 + gap }, { 0, 1.5 + gap },
      { 0, 1.5 + gap }, { 2.5 - gap, 1.5 + gap }, { 2.5 - gap, 3 }, { 0, 3 },
      { 2.5 + gap, 1.5 + gap }, { 4, 1.5 + gap }, { 4, 3 }, { 2.5 + gap, 3 } };
    Labels labels(12, -1);
    Progress progress{ Context() };
    labelPolygons(corners, { 0, 4, 8, 12 }, { 4, 3 }, labels.data(), progress);
    for (std::size_t pixel = 0; pixel < 12; ++pixel)
    {
      const std::int64_t label = labels[pixel];
      const bool isOnBorder = pixel / 4 == 1 || pixel == 10;
      EXPECT_TRUE(label >= 0 && label < 3) << pixel;
      EXPECT_TRUE(isOnBorder || label == (pixel < 4 ? 0 : pixel < 10 ? 1 : 2)) << pixel;
    }
  }
}

TEST(PowerSiteCells, ThreadsDoNotMatter)
{
  const ImageGrid grid = makeGrid<2>({ 300, 200 }, { 0.1, 0.1, 1.0 });
  Points<3> sites = inPlane(randomPoints<2>({ 30, 20 }, 900, 14));
  sites[40] = sites[20];
  const auto result = [&](const Executor& threads) {
    const PowerSiteCells cells(sites, grid, threads);
    Figures figures = measure(cells);
    return std::make_tuple(labelsOf(cells, grid, threads), cells.Outlines().Points, figures.Mass,
      figures.Centroid, figures.Cost, figures.Total);
  };
  const auto serial = result(SerialExecutor());
  for (const int threads : { 1, 2, 3 })
  {
    EXPECT_EQ(result(ThreadsExecutor(threads)), serial) << threads;
  }
}

TEST(PowerSiteCells, Refusals)
{
  ImageGrid::Matrix sheared = ImageGrid::Matrix::Identity();
  sheared(0, 1) = 0.3;
  const ImageGrid skew({ 0, 4, 0, 4, 0, 0 }, { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 }, sheared, false);
  EXPECT_EQ(refusal([&]() {
    PowerSiteCells(Points<3>{ { 1, 1, 0 } }, skew);
  }),
    "The axes of the domain are not at right angles");
}

TEST(PowerSiteCells, Cancelled)
{
  const ImageGrid grid = makeGrid<2>({ 400, 400 }, { 1.0, 1.0, 1.0 });
  const Points<3> sites = inPlane(randomPoints<2>({ 400, 400 }, 600, 3));
  const SerialExecutor threads;
  RecordingContext recording(threads);
  const PowerSiteCells cells(sites, grid, recording.Context());
  recording.ExpectReported(0.0, 1.0);
  recording.Queries = 0;
  recording.MaximumQueries = 3;
  EXPECT_THROW(PowerSiteCells(sites, grid, recording.Context()), Cancelled);
  recording.MaximumQueries = 0;
  EXPECT_THROW(labelsOf(cells, grid, recording.Context()), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
