// SPDX-License-Identifier: BSD-3-Clause
// Cells of equal mass from sites and a grid alone: their labels, what is measured of them, their
// outlines.
#include "Core/SiteCells/SiteCellOutlines.h"
#include "Core/SiteCells/SiteCellStatistics.h"
#include "Core/SiteCells/SiteCells.h"
#include "TestFlow.h"
#include "TestGrid.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

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

template <int Dimension>
Figures measure(const SiteCells<Dimension>& cells, const Labels& labels, const CostNorm& norm = {},
  const Context& context = Context())
{
  const auto count = static_cast<std::size_t>(cells.NumberOfSites());
  Figures figures{ std::vector<double>(count), Points<3>(count), std::vector<double>(count), 0.0 };
  figures.Total = measureSiteCells<Dimension>(cells, labels.data(), norm,
    { figures.Mass.data(), figures.Centroid, figures.Cost.data() }, context);
  return figures;
}

double sum(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Sites in the middles of equal parts of the domain: by symmetry the cells are these parts.
TEST(SiteCellStatistics, Quarters)
{
  const auto grid = makeGrid<2>({ 8, 4 }, { 0.5, 2.0, 1.0 }, { 10.0, -4.0, 3.0 });
  const Points<3> sites = { { 11.0, -2.0, 3.0 }, { 13.0, -2.0, 3.0 }, { 11.0, 2.0, 3.0 },
    { 13.0, 2.0, 3.0 } };
  const Labels labels = labelSiteCells<2>(sites, grid);
  const Labels low = { 0, 0, 0, 0, 1, 1, 1, 1 };
  const Labels high = { 2, 2, 2, 2, 3, 3, 3, 3 };
  for (std::size_t row = 0; row < 4; ++row)
  {
    const auto begin = labels.begin() + 8 * static_cast<std::ptrdiff_t>(row);
    EXPECT_EQ(Labels(begin, begin + 8), row < 2 ? low : high) << row;
  }
  const SiteCells<2> cells(sites, grid);
  EXPECT_EQ(cells.NumberOutside(), 0);
  const Figures figures = measure<2>(cells, labels);
  // Of four columns of width 0.5 and two rows of height 2 about the middle.
  const double cost = (0.25 * 0.25 + 0.75 * 0.75) / 2 + 1.0;
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    EXPECT_EQ(figures.Mass[i], 8.0);
    EXPECT_EQ(figures.Centroid[i], sites[i]);
    EXPECT_EQ(figures.Cost[i], cost / 4);
  }
  EXPECT_EQ(figures.Total, cost);
  // |x|_1 of the same way, and |x|_inf^1, which is the height.
  EXPECT_NEAR(measure<2>(cells, labels, { 1.0, 1.0 }).Total, 0.5 + 1.0, 1e-14);
  const double largest = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(measure<2>(cells, labels, { largest, 1.0 }).Total, 1.0, 1e-14);
}

TEST(SiteCellStatistics, AnyNumberOfSites)
{
  const GridSize<3> size = { 20, 16, 12 };
  const auto grid = makeGrid<3>(size, { 0.5, 0.75, 1.0 });
  Points<3> sites = randomPoints<3>({ 10, 12, 12 }, 37);
  sites[5] = sites[30]; // they share a cell
  sites[7] = { -3.0, 5.0, 6.0 };
  const SiteCells<3> cells(sites, grid);
  EXPECT_EQ(cells.NumberOutside(), 1);
  Labels labels(3840);
  cells.Label(labels.data());
  EXPECT_EQ(labels, labelSiteCells<3>(sites, grid));
  Labels counts(37, 0);
  for (const std::int64_t label : labels)
  {
    ++counts.at(static_cast<std::size_t>(label));
  }
  for (const std::int64_t count : counts)
  {
    EXPECT_TRUE(count == 103 || count == 104) << count;
  }
  const Figures figures = measure<3>(cells, labels);
  EXPECT_NEAR(sum(figures.Mass), 10.0 * 12.0 * 12.0, 1e-9);
  EXPECT_EQ(figures.Mass[5], figures.Mass[30]);
  EXPECT_NEAR(sum(figures.Cost), figures.Total, 1e-9);
  const Figures serial = measure<3>(cells, labels, {}, SerialExecutor());
  EXPECT_EQ(figures.Total, serial.Total);
  EXPECT_EQ(figures.Centroid, serial.Centroid);
}

// Runs on the caller's thread and keeps the length of each loop that it is given.
class RecordingExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override
  {
    this->Lengths.push_back(count);
    SerialExecutor().For(count, grain, kernel);
  }
  int Concurrency() const override { return 1; }

  mutable std::vector<std::int64_t> Lengths;
};

// A one-off is the constructor and Label, with the caller's executor and progress in both: the
// first loop is the constructor's, over the sites.
TEST(SiteCellStatistics, OneOffKeepsTheContext)
{
  const auto grid = makeGrid<2>({ 40, 30 }, { 1.0, 1.0, 1.0 });
  const Points<3> sites = { { 4.0, 3.0, 0.0 }, { 30.0, 20.0, 0.0 }, { 7.0, 25.0, 0.0 } };
  const RecordingExecutor threads;
  std::vector<double> heard;
  const Context context(threads, [&heard](double progress) { heard.push_back(progress); });
  const Labels labels = labelSiteCells<2>(sites, grid, {}, context);
  ASSERT_GT(threads.Lengths.size(), 1u);
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  EXPECT_LT(heard.front(), 0.1);
  EXPECT_GT(heard.back(), 0.9);

  Labels expected(1200);
  SiteCells<2>(sites, grid).Label(expected.data());
  EXPECT_EQ(labels, expected);
}

TEST(SiteCellStatistics, OneOffIsCancelledWhilePlacing)
{
  const auto grid = makeGrid<2>({ 40, 30 }, { 1.0, 1.0, 1.0 });
  const Points<3> sites = { { 4.0, 3.0, 0.0 }, { 30.0, 20.0, 0.0 } };
  const RecordingExecutor threads;
  const Context context(threads, {}, []() { return true; });
  EXPECT_THROW(labelSiteCells<2>(sites, grid, {}, context), Cancelled);
  EXPECT_TRUE(threads.Lengths.empty()); // so few are placed by the calling thread
}

TEST(SiteCellStatistics, WhatIsWrong)
{
  const auto grid = makeGrid<1>({ 2 }, { 1e200, 1.0, 1.0 });
  EXPECT_THROW(SiteCells<1>(Points<3>{ { 0.0 }, { 1.0 }, { 2.0 } }, grid), std::invalid_argument);
  const SiteCells<1> cells(Points<3>{ { 5e199, 0.0, 0.0 }, { 1e200, 0.0, 0.0 } }, grid);
  EXPECT_THROW(measure<1>(cells, { 0, 1 }), std::overflow_error);
  EXPECT_NEAR(measure<1>(cells, { 0, 1 }, { 2.0, 1.0 }).Total, 2.5e199, 1e186);
}

// Each way around a cell, or each side of a quad, is met once in each direction.
template <int Dimension>
void expectClosed(const GridSize<Dimension>& size, const ImageGrid& grid, const Labels& labels)
{
  const auto outlines = outlineSiteCells<Dimension>(grid, labels.data());
  constexpr int corners = SiteCellOutlines<Dimension>::Corners;
  ASSERT_EQ(outlines.CornerIds.size(), corners * outlines.SiteIds.size());
  std::map<std::pair<std::int64_t, std::int64_t>, int> ends; // of a cell's lines, or quads' sides
  std::map<std::int64_t, double> measures;
  for (std::size_t face = 0; face < outlines.SiteIds.size(); ++face)
  {
    const std::int64_t site = outlines.SiteIds[face];
    const auto corner = [&](std::size_t i) {
      return outlines.CornerIds[face * corners + i % corners];
    };
    const auto at = [&](std::size_t i) {
      const Point<3>& x = outlines.Points[static_cast<std::size_t>(corner(i))];
      return Eigen::Vector3d(x[0], x[1], x[2]);
    };
    if (Dimension == 2)
    {
      ++ends[{ site, corner(0) }];
      --ends[{ site, corner(1) }];
      measures[site] += 0.5 * (at(0)[0] * at(1)[1] - at(0)[1] * at(1)[0]);
    }
    else
    {
      const auto points = static_cast<std::int64_t>(outlines.Points.size());
      for (std::size_t i = 0; i < corners; ++i)
      {
        ++ends[{ site, corner(i) * points + corner(i + 1) }];
        --ends[{ site, corner(i + 1) * points + corner(i) }];
      }
      measures[site] += at(0).dot((at(1) - at(0)).cross(at(3) - at(0))) / 3.0;
    }
  }
  for (const auto& end : ends)
  {
    EXPECT_EQ(end.second, 0);
  }
  std::map<std::int64_t, double> expected;
  for (const std::int64_t label : labels)
  {
    expected[label] += grid.CellMeasure();
  }
  EXPECT_EQ(measures.size(), expected.size());
  for (const auto& [site, measure] : expected)
  {
    EXPECT_NEAR(measures[site], measure, 1e-9) << site << " of " << cellCount<Dimension>(size);
  }
}

// The divergence theorem: what the borders enclose is what the pixels cover.
TEST(SiteCellOutlines, CloseAroundTheCells)
{
  std::mt19937_64 engine(5);
  const auto noise = [&engine](std::size_t count) {
    Labels labels(count);
    for (std::int64_t& label : labels)
    {
      label = static_cast<std::int64_t>(5 * uniformNumber(engine));
    }
    return labels;
  };
  expectClosed<2>({ 7, 5 }, makeGrid<2>({ 7, 5 }, { 0.5, 2.0, 1.0 }, { 1, 2, 3 }), noise(35));
  expectClosed<3>({ 4, 5, 3 }, makeGrid<3>({ 4, 5, 3 }, { 0.5, 2.0, 1.5 }), noise(60));
  // Of a mirrored image, too.
  expectClosed<3>({ 4, 5, 3 }, makeGrid<3>({ 4, 5, 3 }, { 0.5, -2.0, 1.5 }), noise(60));
}

TEST(SiteCellOutlines, OnALine)
{
  const auto outlines = outlineSiteCells<1>(
    makeGrid<1>({ 4 }, { 0.5, 1.0, 1.0 }, { 1.0, 2.0, 3.0 }), Labels{ 1, 1, 0, 0 }.data());
  EXPECT_EQ(
    outlines.Points, (Points<3>{ { 1.0, 2.0, 3.0 }, { 2.0, 2.0, 3.0 }, { 3.0, 2.0, 3.0 } }));
  EXPECT_EQ(outlines.CornerIds, (Labels{ 0, 1, 1, 2 }));
  EXPECT_EQ(outlines.SiteIds, (Labels{ 1, 1, 0, 0 }));
}

} // namespace
} // namespace RectifiedTransport
