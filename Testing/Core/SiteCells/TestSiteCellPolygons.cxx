// SPDX-License-Identifier: BSD-3-Clause
// The polygons of labelled pixels.
#include "Core/SiteCells/SiteCellPolygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace RectifiedTransport
{
namespace
{

using Labels = std::vector<std::int64_t>;

// Pixels of 2 by 3, with a corner at (10, 20).
ImageGrid makeGrid(int width, int height)
{
  return ImageGrid({ 0, width, 0, height, 0, 0 }, { 10.0, 20.0, 5.0 }, { 2.0, 3.0, 1.0 },
    ImageGrid::Matrix::Identity(), false);
}

std::vector<Point<2>> cornersOf(const SiteCellPolygons& polygons, std::size_t polygon)
{
  std::vector<Point<2>> corners;
  for (std::int64_t i = polygons.First[polygon]; i < polygons.First[polygon + 1]; ++i)
  {
    const Point<3>& x =
      polygons.Points[static_cast<std::size_t>(polygons.CornerIds[static_cast<std::size_t>(i)])];
    corners.push_back({ (x[0] - 10.0) / 2.0, (x[1] - 20.0) / 3.0 });
    EXPECT_EQ(x[2], 5.0);
  }
  return corners;
}

// In pixels; positive if the corners turn from the first axis to the second.
double areaOf(const std::vector<Point<2>>& corners)
{
  double twice = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Point<2>& a = corners[i];
    const Point<2>& b = corners[(i + 1) % corners.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2.0;
}

// How often the corners go around a point.
int turnsAround(const std::vector<Point<2>>& corners, const Point<2>& x)
{
  int turns = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Point<2>& a = corners[i];
    const Point<2>& b = corners[(i + 1) % corners.size()];
    // Sides are along the axes.
    EXPECT_TRUE((a[0] == b[0]) != (a[1] == b[1]));
    if (a[0] == b[0] && a[0] > x[0] && std::min(a[1], b[1]) < x[1] && std::max(a[1], b[1]) > x[1])
    {
      turns += b[1] > a[1] ? 1 : -1;
    }
  }
  return turns;
}

// Each pixel is in one polygon, once, and that is one of its site.
void expectPolygonsOf(const Labels& labels, int width, int height)
{
  const SiteCellPolygons polygons = polygonsOfSiteCells(makeGrid(width, height), labels.data());
  ASSERT_EQ(polygons.First.size(), polygons.SiteIds.size() + 1);
  EXPECT_TRUE(std::is_sorted(polygons.SiteIds.begin(), polygons.SiteIds.end()));
  std::vector<int> covered(labels.size(), 0);
  for (std::size_t k = 0; k < polygons.SiteIds.size(); ++k)
  {
    const auto corners = cornersOf(polygons, k);
    double inside = 0.0;
    for (std::size_t pixel = 0; pixel < labels.size(); ++pixel)
    {
      const auto x = static_cast<double>(pixel % static_cast<std::size_t>(width));
      const auto y = static_cast<double>(pixel / static_cast<std::size_t>(width));
      const int turns = turnsAround(corners, { x + 0.5, y + 0.5 });
      ASSERT_TRUE(turns == 0 || turns == 1);
      if (turns == 1)
      {
        EXPECT_EQ(labels[pixel], polygons.SiteIds[k]);
        ++covered[pixel];
        inside += 1.0;
      }
    }
    EXPECT_EQ(areaOf(corners), inside);
  }
  for (std::size_t pixel = 0; pixel < labels.size(); ++pixel)
  {
    EXPECT_EQ(covered[pixel], labels[pixel] < 0 ? 0 : 1);
  }
}

TEST(SiteCellPolygons, CornersWhereTheyTurnOrMeet)
{
  // 1 1 1 1
  // 0 0 2 2
  const Labels labels = { 0, 0, 2, 2, 1, 1, 1, 1 };
  const SiteCellPolygons polygons = polygonsOfSiteCells(makeGrid(4, 2), labels.data());
  EXPECT_EQ(polygons.SiteIds, (Labels{ 0, 1, 2 }));
  EXPECT_EQ(polygons.Points.size(), 8U); // none between two sites alone
  EXPECT_EQ(polygons.First, (Labels{ 0, 4, 9, 13 }));
  expectPolygonsOf(labels, 4, 2);
}

TEST(SiteCellPolygons, OfSeveralParts)
{
  // Corners alone do not connect.
  expectPolygonsOf({ 0, 1, 1, 0 }, 2, 2);
  expectPolygonsOf({ 0, 0, 1, 1, 0, 0 }, 6, 1);
  EXPECT_EQ(polygonsOfSiteCells(makeGrid(2, 2), Labels{ 0, 1, 1, 0 }.data()).SiteIds,
    (Labels{ 0, 0, 1, 1 }));
}

TEST(SiteCellPolygons, WithHoles)
{
  const Labels labels = { 0, 0, 0, 0, 0, 0, 0, //
    0, 1, 0, -1, 0, 2, 0,                      //
    0, 0, 0, 0, -1, 0, 0,                      //
    0, 3, 3, 3, 0, 0, 0,                       //
    0, 3, 0, 3, 0, -1, 0,                      //
    0, 3, 3, 3, 0, 0, 0,                       //
    0, 0, 0, 0, 0, 0, 0 };
  expectPolygonsOf(labels, 7, 7);
  const SiteCellPolygons polygons = polygonsOfSiteCells(makeGrid(7, 7), labels.data());
  EXPECT_GT(polygons.SiteIds.size(), 5U);
  for (std::size_t k = 0; k < polygons.SiteIds.size(); ++k)
  {
    // No side is run through in both directions.
    const auto corners = cornersOf(polygons, k);
    std::set<std::pair<Point<2>, Point<2>>> sides;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const Point<2>& end = corners[(i + 1) % corners.size()];
      EXPECT_EQ(sides.count({ end, corners[i] }), 0U);
      sides.insert({ corners[i], end });
    }
  }
}

TEST(SiteCellPolygons, NoPixels)
{
  const SiteCellPolygons polygons =
    polygonsOfSiteCells(makeGrid(2, 2), Labels{ -1, -1, -1, -1 }.data());
  EXPECT_TRUE(polygons.SiteIds.empty());
  EXPECT_EQ(polygons.First, (Labels{ 0 }));
}

TEST(SiteCellPolygons, OfAnyLabels)
{
  std::uint32_t state = 1;
  const auto next = [&state](std::uint32_t below) {
    state = state * 1664525U + 1013904223U;
    return static_cast<std::int64_t>((state >> 16) % below);
  };
  for (int run = 0; run < 60; ++run)
  {
    const auto width = static_cast<int>(1 + next(24));
    const auto height = static_cast<int>(1 + next(24));
    const std::int64_t sites = 1 + next(4);
    Labels labels(static_cast<std::size_t>(width * height));
    std::generate(labels.begin(), labels.end(),
      [&]() { return next(10) < 6 ? 0 : next(static_cast<std::uint32_t>(sites) + 1) - 1; });
    expectPolygonsOf(labels, width, height);
  }
}

// No point is inside a side of a polygon: a map keeps polygons together that share it.
TEST(SiteCellPolygons, ShareTheirSides)
{
  Labels labels(30 * 30);
  std::uint32_t state = 7;
  std::generate(labels.begin(), labels.end(), [&state]() {
    state = state * 1664525U + 1013904223U;
    return static_cast<std::int64_t>((state >> 20) % 3);
  });
  const SiteCellPolygons polygons = polygonsOfSiteCells(makeGrid(30, 30), labels.data());
  std::map<std::pair<std::int64_t, std::int64_t>, int> sides;
  for (std::size_t k = 0; k < polygons.SiteIds.size(); ++k)
  {
    const std::int64_t count = polygons.First[k + 1] - polygons.First[k];
    for (std::int64_t i = 0; i < count; ++i)
    {
      const auto at = [&](std::int64_t corner) {
        return polygons.CornerIds[static_cast<std::size_t>(polygons.First[k] + corner % count)];
      };
      ++sides[{ at(i), at(i + 1) }];
    }
  }
  int onBorder = 0;
  for (const auto& [side, count] : sides)
  {
    EXPECT_EQ(count, 1);
    onBorder += sides.count({ side.second, side.first }) == 0 ? 1 : 0;
  }
  const std::set<std::int64_t> used(polygons.CornerIds.begin(), polygons.CornerIds.end());
  EXPECT_EQ(used.size(), polygons.Points.size());
  EXPECT_GT(sides.size(), 1000U);
  EXPECT_LE(onBorder, 4 * 30);
}

} // namespace
} // namespace RectifiedTransport
