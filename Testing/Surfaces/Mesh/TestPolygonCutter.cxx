// SPDX-License-Identifier: BSD-3-Clause
// Polygons, strips and quads as triangles: as many as there are corners beyond the second, with all
// edges of the polygon and its area, also with coincident and collinear corners.
#include "Core/Geometry/Vectors.h"
#include "Surfaces/Mesh/CutPolygons.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <set>

namespace RectifiedTransport
{
namespace
{

using Corners = PolygonCutter::Corners;

// Of convex rings in the plane z = 0, as a fan. Like vtkPolygon it refuses corners at one place or
// on one line, here with a tolerance of 1e-6.
bool cutConvex(const std::vector<Point<3>>& ring, std::vector<std::size_t>& triangles)
{
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
  {
    for (const std::size_t j : { i, i + 1 })
    {
      const Point<3>& a = ring[j - 1];
      if (!(cross(ring[j] - a, ring[(j + 1) % ring.size()] - a)[2] > 1e-6))
      {
        return false;
      }
    }
    triangles.insert(triangles.end(), { std::size_t{ 0 }, i, i + 1 });
  }
  return true;
}

struct Polygon
{
  std::vector<Point<3>> Points;

  Corners All() const
  {
    Corners corners(this->Points.size());
    std::iota(corners.begin(), corners.end(), 0);
    return corners;
  }
  PolygonCutter Cutter(double rounding = 0.0) const
  {
    return { this->Points, rounding, cutConvex };
  }
  double AreaOf(const std::vector<std::int64_t>& triangles) const
  {
    double area = 0.0;
    for (std::size_t i = 0; i < triangles.size(); i += 3)
    {
      const auto at = [&](std::size_t k) {
        return this->Points[static_cast<std::size_t>(triangles[i + k])];
      };
      const Point<3> normal = cross(at(1) - at(0), at(2) - at(0));
      area += 0.5 * std::sqrt(dot(normal, normal));
    }
    return area;
  }
};

// Each side of the polygon is a side of one triangle, in its direction.
void expectSides(const Corners& corners, const std::vector<std::int64_t>& triangles)
{
  std::multiset<std::array<std::int64_t, 2>> sides;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    sides.insert({ triangles[i], triangles[i % 3 == 2 ? i - 2 : i + 1] });
  }
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    EXPECT_EQ(sides.count({ corners[i], corners[(i + 1) % corners.size()] }), 1u) << i;
  }
}

TEST(PolygonCutter, EveryEdgeIsThatOfATriangle)
{
  const std::vector<Polygon> polygons{
    { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } } },
    { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } } },
    { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } } },
    { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 0 } } },
    { { { 0, 0, 0 }, { 0.5, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 0 } } },
    { { { 0, 0, 0 }, { 0.5, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0.5, 0 }, { 1, 1, 0 },
      { 0, 1, 0 } } },
  };
  for (const Polygon& polygon : polygons)
  {
    PolygonCutter cutter = polygon.Cutter();
    ASSERT_TRUE(cutter.Cut(polygon.All()));
    EXPECT_EQ(cutter.Triangles().size(), 3 * (polygon.Points.size() - 2));
    EXPECT_NEAR(polygon.AreaOf(cutter.Triangles()), polygon.Points.size() == 3 ? 0.5 : 1.0, 1e-12);
    expectSides(polygon.All(), cutter.Triangles());
  }
}

TEST(PolygonCutter, CornersThatDifferByRoundingAreOne)
{
  Polygon square{ { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1e-5, 0 }, { 1, 1, 0 }, { 0, 1, 0 } } };
  square.Points[2][0] -= 1e-5; // a notch
  EXPECT_FALSE(square.Cutter().Cut(square.All()));
  PolygonCutter cutter = square.Cutter(1e-4);
  ASSERT_TRUE(cutter.Cut(square.All()));
  expectSides(square.All(), cutter.Triangles());
}

TEST(PolygonCutter, ALineHasTrianglesWithoutArea)
{
  const Polygon line{ { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 } } };
  PolygonCutter cutter = line.Cutter();
  ASSERT_TRUE(cutter.Cut(line.All()));
  EXPECT_EQ(cutter.Triangles(), (std::vector<std::int64_t>{ 0, 1, 2, 0, 2, 3 }));
  EXPECT_TRUE(cutter.Cut({ 2, 1 }));
  EXPECT_TRUE(cutter.Triangles().empty());
}

TEST(PolygonCutter, WhatCannotBeCutBecomesAFan)
{
  const Polygon crossed{ { { 0, 0, 0 }, { 2, 2, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { -1, 1, 0 } } };
  PolygonCutter cutter = crossed.Cutter();
  EXPECT_FALSE(cutter.Cut(crossed.All()));
  cutter.CutThin(crossed.All());
  EXPECT_EQ(cutter.Triangles(), (std::vector<std::int64_t>{ 0, 1, 2, 0, 2, 3, 0, 3, 4 }));
}

// By the shorter diagonal, or the one within, whichever corner is the first.
TEST(PolygonCutter, QuadsDoNotDependOnTheirFirstCorner)
{
  const std::vector<std::pair<Polygon, std::set<std::int64_t>>> quads{
    { { { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 1, 0 }, { 0.5, 1, 0 } } }, { 1, 3 } },
    { { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } } }, { 0, 2 } },
    { { { { 0, 0, 0 }, { 2, 2, 0 }, { 0, 0.5, 0 }, { -2, 2, 0 } } }, { 0, 2 } },
    { { { { -2, 2, 0 }, { 0, 0, 0 }, { 2, 2, 0 }, { 0, 0.5, 0 } } }, { 1, 3 } },
  };
  for (const auto& [quad, diagonal] : quads)
  {
    PolygonCutter cutter = quad.Cutter();
    for (std::int64_t first = 0; first < 4; ++first)
    {
      const Corners corners{ first, (first + 1) % 4, (first + 2) % 4, (first + 3) % 4 };
      cutter.CutThin(corners);
      ASSERT_EQ(cutter.Triangles().size(), 6u);
      std::set<std::int64_t> shared;
      for (std::int64_t corner = 0; corner < 4; ++corner)
      {
        if (std::count(cutter.Triangles().begin(), cutter.Triangles().end(), corner) == 2)
        {
          shared.insert(corner);
        }
      }
      EXPECT_EQ(shared, diagonal) << first;
      expectSides(corners, cutter.Triangles());
    }
  }
}

TEST(PolygonCutter, StripsTurnOneWay)
{
  const Polygon strip{ { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 2, 0, 0 } } };
  PolygonCutter cutter = strip.Cutter();
  cutter.CutStrip(strip.All());
  EXPECT_EQ(cutter.Triangles(), (std::vector<std::int64_t>{ 0, 1, 2, 2, 1, 3, 2, 3, 4 }));
}

} // namespace
} // namespace RectifiedTransport
