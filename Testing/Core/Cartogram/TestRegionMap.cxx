// SPDX-License-Identifier: BSD-3-Clause
// Areas of regions with holes and islands, and edges that are divided alike on both sides.
#include "MapSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace RectifiedTransport
{
namespace
{

// A region with a hole and an island in it; another one in the hole.
TEST(RegionMap, HolesInAnyDirection)
{
  for (int turned = 0; turned < 8; ++turned)
  {
    RegionMap map;
    const Ring rings[] = { rectangle(0, 0, 10, 10), rectangle(1, 1, 9, 9), rectangle(4, 4, 6, 6) };
    for (int i = 0; i < 3; ++i)
    {
      Ring ring = rings[i];
      if ((turned >> i & 1) != 0)
      {
        std::reverse(ring.begin(), ring.end());
      }
      addRing(map, 0, ring);
    }
    addRing(map, 1, rectangle(1, 1, 9, 3));
    map.FindHoles();
    EXPECT_EQ(map.Areas(2), (std::vector<double>{ 100.0 - 64.0 + 4.0, 16.0 }));
    EXPECT_FALSE(map.IsHole(0));
    EXPECT_TRUE(map.IsHole(1));
    EXPECT_FALSE(map.IsHole(2));
    for (std::int64_t ring = 0; ring < 3; ++ring)
    {
      EXPECT_GT(map.AreaOf(ring), 0.0);
    }
  }
}

TEST(RegionMap, HoleThatTouchesItsOutline)
{
  RegionMap map;
  addRing(map, 0, rectangle(0, 0, 4, 4));
  addRing(map, 0, { { 0.0, 0.0 }, { 2.0, 1.0 }, { 1.0, 2.0 } });
  map.FindHoles();
  EXPECT_TRUE(map.IsHole(1));
  EXPECT_DOUBLE_EQ(map.Areas(1)[0], 16.0 - 1.5);
}

TEST(RegionMap, WayToAHoleAndBack)
{
  RegionMap map;
  addRing(map, 0,
    { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 }, { 0, 0 }, { 1, 1 }, { 1, 3 }, { 3, 3 }, { 3, 1 },
      { 1, 1 } });
  map.FindHoles();
  EXPECT_DOUBLE_EQ(map.Areas(1)[0], 12.0);
}

// By the even-odd rule, whatever runs in which direction.
TEST(RegionMap, OutlinesThatCross)
{
  struct Case
  {
    std::vector<Ring> Rings;
    double Area;
    std::size_t Added; // points that divide edges
  };
  const Ring eight{ { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 2 } };
  const Ring star{ { 0, 3 }, { 6, 3 }, { 1, 0 }, { 3, 5 }, { 5, 0 } }; // its middle is outside
  const Case cases[] = {
    { { eight }, 2.0, 2 }, { { eight, rectangle(5, 0, 6, 1) }, 3.0, 2 },
    { { rectangle(0, 0, 3, 3), rectangle(2, 1, 5, 2) }, 9.0 - 1.0 + 2.0, 4 },
    { { rectangle(0, 0, 8, 8), { { 1, 1 }, { 3, 3 }, { 3, 1 }, { 1, 3 } } }, 64.0 - 2.0, 2 },
    { { star }, 6.8838709677419354, 10 }, // a sum over lines, too
  };
  for (const Case& sample : cases)
  {
    for (const bool isTurned : { false, true })
    {
      RegionMap map;
      for (Ring ring : sample.Rings)
      {
        if (isTurned)
        {
          std::reverse(ring.begin(), ring.end());
        }
        addRing(map, 0, ring);
      }
      addRing(map, 1, rectangle(10, 0, 11, 1));
      const auto points = static_cast<std::int64_t>(map.Points().size());
      const std::vector<DividingPoint> added = map.FindHoles();
      EXPECT_EQ(added.size(), sample.Added);
      EXPECT_EQ(map.Points().size(), static_cast<std::size_t>(points) + added.size());
      EXPECT_NEAR(map.Areas(2)[0], sample.Area, 1e-12);
      EXPECT_EQ(map.Areas(2)[1], 1.0);
      map.Divide([](const Point<2>&) { return 0.1; });
      EXPECT_NEAR(map.Areas(2)[0], sample.Area, 1e-12);
    }
  }
}

// A figure of eight divides the edge of its neighbour where it divides its own.
TEST(RegionMap, CrossingsOnBorders)
{
  RegionMap map;
  addRing(map, 0, { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 3, -1 }, { 0, 4 } });
  addRing(map, 1, { { 0, 0 }, { 4, 0 }, { 2, -5 } });
  EXPECT_FALSE(map.FindHoles().empty());
  std::set<std::pair<Point<2>, Point<2>>> edges;
  map.VisitEdges(0, [&](std::int64_t from, std::int64_t to) {
    edges.insert(std::minmax(
      map.Points()[static_cast<std::size_t>(from)], map.Points()[static_cast<std::size_t>(to)]));
  });
  int shared = 0;
  map.VisitEdges(1, [&](std::int64_t from, std::int64_t to) {
    shared += static_cast<int>(edges.count(std::minmax(
      map.Points()[static_cast<std::size_t>(from)], map.Points()[static_cast<std::size_t>(to)])));
  });
  EXPECT_EQ(shared, 3);
}

// They are divided as borders in the same places, and are no part of a region.
TEST(RegionMap, OpenLines)
{
  RegionMap map;
  addRing(map, 0, rectangle(0, 0, 2, 1));
  std::vector<std::int64_t> line;
  for (const Point<2>& place : { Point<2>{ -1, 0 }, { 0, 0 }, { 2, 0 }, { 5, 3 } })
  {
    line.push_back(map.AddPoint(place));
  }
  map.AddLine(line);
  map.AddLine({});
  EXPECT_TRUE(map.FindHoles().empty());
  EXPECT_TRUE(map.IsOpen(1) && map.IsOpen(2) && !map.IsOpen(0));
  EXPECT_EQ(map.Areas(1), std::vector<double>{ 2.0 });
  EXPECT_EQ(map.RingsOfRegions().size(), 1U);
  map.Divide([](const Point<2>&) { return 0.5; });
  EXPECT_EQ(map.CountOf(0), 12);
  EXPECT_EQ(map.CountOf(1), 2 + 4 + 9 + 1);
  EXPECT_EQ(map.CornerOf(1, 0), line.front());
  EXPECT_EQ(map.CornerOf(1, map.CountOf(1) - 1), line.back());
  EXPECT_EQ(map.CountOf(2), 0);
  for (std::int64_t i = 0; i <= 4; ++i)
  {
    EXPECT_EQ(map.Points()[static_cast<std::size_t>(map.CornerOf(0, i))],
      map.Points()[static_cast<std::size_t>(map.CornerOf(1, 2 + i))]);
  }
}

TEST(RegionMap, AreasAreSignedAfterwards)
{
  RegionMap map = squares(1);
  std::swap(map.Points()[0], map.Points()[1]);
  std::swap(map.Points()[2], map.Points()[3]);
  EXPECT_DOUBLE_EQ(map.AreaOf(0), -1.0);
}

TEST(RegionMap, DividesBothSidesAlike)
{
  for (const bool areShared : { false, true })
  {
    RegionMap map = squares(3, areShared);
    const std::size_t before = map.Points().size();
    const auto longest = [](const Point<2>& middle) { return middle[0] < 1.5 ? 0.3 : 0.07; };
    const std::vector<DividingPoint> added = map.Divide(longest);
    EXPECT_EQ(map.Points().size(), before + added.size());
    for (std::size_t i = 0; i < added.size(); ++i)
    {
      const Point<2>& a = map.Points()[static_cast<std::size_t>(added[i].First)];
      const Point<2>& b = map.Points()[static_cast<std::size_t>(added[i].Second)];
      const Point<2>& made = map.Points()[before + i];
      EXPECT_DOUBLE_EQ(made[0], a[0] + added[i].At * (b[0] - a[0]));
      EXPECT_DOUBLE_EQ(made[1], a[1] + added[i].At * (b[1] - a[1]));
    }
    // Edges inside the map occur once each way, to the last bit.
    std::map<std::pair<Point<2>, Point<2>>, int> edges;
    for (std::int64_t ring = 0; ring < map.Rings(); ++ring)
    {
      map.VisitEdges(ring, [&](std::int64_t from, std::int64_t to) {
        const Point<2>& a = map.Points()[static_cast<std::size_t>(from)];
        const Point<2>& b = map.Points()[static_cast<std::size_t>(to)];
        EXPECT_LT(std::hypot(b[0] - a[0], b[1] - a[1]),
          longest({ 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) }) + 0.3);
        ++edges[{ a, b }];
      });
    }
    int outside = 0;
    for (const auto& [edge, count] : edges)
    {
      EXPECT_EQ(count, 1);
      outside += edges.count({ edge.second, edge.first }) == 0 ? 1 : 0;
    }
    EXPECT_GT(outside, 12);
    EXPECT_LT(2 * outside, static_cast<int>(edges.size()) + 2 * outside);
    for (const auto& [edge, count] : edges)
    {
      const Point<2> middle{ 0.5 * (edge.first[0] + edge.second[0]),
        0.5 * (edge.first[1] + edge.second[1]) };
      const bool isInside =
        middle[0] > 0.0 && middle[0] < 3.0 && middle[1] > 0.0 && middle[1] < 3.0;
      EXPECT_EQ(edges.count({ edge.second, edge.first }), isInside ? 1U : 0U);
    }
    std::vector<double> areas = map.Areas(9);
    for (const double area : areas)
    {
      EXPECT_NEAR(area, 1.0, 1e-14);
    }
  }
}

} // namespace
} // namespace RectifiedTransport
