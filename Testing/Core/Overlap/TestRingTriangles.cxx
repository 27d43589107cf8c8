// SPDX-License-Identifier: BSD-3-Clause
// Rings as triangles: their area against a sum over trapezoids by the even-odd rule, for rings that
// cross, touch, lie on each other, in each other or nearly so; places inside; many rings.
#include "Core/Overlap/RingTriangles.h"
#include "Core/Parallel/Progress.h"

#include "TestRings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

RingTriangles triangulated(const Rings& rings)
{
  Progress progress{ Context() };
  return triangulateRings(rings, progress);
}

Point<2> cornerOf(const Rings& rings, const RingTriangles& triangles, std::int32_t corner)
{
  const std::int64_t added = corner - rings.Edges();
  return added < 0 ? rings.At(corner) : triangles.Added[static_cast<std::size_t>(added)].Place;
}

double areaOf(const std::vector<Ring>& all)
{
  const Rings rings = ringsOf(all);
  const RingTriangles triangles = triangulated(rings);
  double sum = 0.0;
  for (const std::array<std::int32_t, 3>& corners : triangles.Corners)
  {
    const Point<2> a = cornerOf(rings, triangles, corners[0]);
    const Point<2> b = cornerOf(rings, triangles, corners[1]);
    const Point<2> c = cornerOf(rings, triangles, corners[2]);
    sum += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  return sum;
}

// Between all heights at which edges end or cross, the area is one of trapezoids.
double trapezoids(const std::vector<Ring>& all)
{
  std::vector<std::array<Point<2>, 2>> edges;
  std::vector<double> heights;
  for (const Ring& ring : all)
  {
    for (std::size_t i = 0; i < ring.size(); ++i)
    {
      edges.push_back({ ring[i], ring[(i + 1) % ring.size()] });
      heights.push_back(ring[i][1]);
    }
  }
  for (const auto& [a, b] : edges)
  {
    for (const auto& [c, d] : edges)
    {
      const double cross = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0]);
      const double part = ((c[0] - a[0]) * (d[1] - c[1]) - (c[1] - a[1]) * (d[0] - c[0])) / cross;
      if (part >= 0.0 && part <= 1.0)
      {
        heights.push_back(a[1] + part * (b[1] - a[1]));
      }
    }
  }
  std::sort(heights.begin(), heights.end());
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i)
  {
    const double y = 0.5 * (heights[i] + heights[i + 1]);
    std::vector<double> places;
    for (const auto& [a, b] : edges)
    {
      if ((a[1] < y) != (b[1] < y))
      {
        places.push_back(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
      }
    }
    std::sort(places.begin(), places.end());
    for (std::size_t k = 0; k + 1 < places.size(); k += 2)
    {
      sum += (heights[i + 1] - heights[i]) * (places[k + 1] - places[k]);
    }
  }
  return sum;
}

Ring square(double low, double high)
{
  return { { low, low }, { high, low }, { high, high }, { low, high } };
}

TEST(RingTriangles, FillWhatIsInsideAnOddNumber)
{
  EXPECT_DOUBLE_EQ(areaOf({ square(0, 4) }), 16);
  EXPECT_DOUBLE_EQ(areaOf({ square(0, 4), square(1, 3) }), 12);
  EXPECT_DOUBLE_EQ(areaOf({ square(0, 8), square(1, 7), square(2, 5) }), 64 - 36 + 9);
  EXPECT_DOUBLE_EQ(areaOf({ square(0, 4), square(2, 6) }), 24);
  EXPECT_DOUBLE_EQ(areaOf({ square(0, 4), square(0, 4) }), 0);
  EXPECT_DOUBLE_EQ(areaOf({ square(0, 4), { { 4, 1 }, { 8, 1 }, { 8, 3 }, { 4, 3 } } }), 24);
  EXPECT_DOUBLE_EQ(areaOf({ square(0, 4), { { 0, 2 }, { 2, 0 }, { 4, 2 }, { 2, 4 } } }), 8);
  const Ring keyhole{ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 }, { 0, 0 }, { 1, 1 }, { 1, 3 },
    { 3, 3 }, { 3, 1 }, { 1, 1 } };
  EXPECT_DOUBLE_EQ(areaOf({ keyhole }), 12);
  EXPECT_DOUBLE_EQ(areaOf({ {}, square(0, 1), { { 5, 5 } }, { { 2, 2 }, { 3, 3 } } }), 1);
  EXPECT_DOUBLE_EQ(areaOf({ { { 0, 0 }, { 0, 0 }, { 0, 0 } } }), 0);
}

// A figure of eight has a point where its edges cross, and where this is on them.
TEST(RingTriangles, AddPointsWhereEdgesCross)
{
  const Rings rings = ringsOf({ { { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 2 } } });
  const RingTriangles triangles = triangulated(rings);
  EXPECT_EQ(triangles.Corners.size(), 2u);
  ASSERT_EQ(triangles.Added.size(), 1u);
  EXPECT_EQ(triangles.Added[0].Place, (Point<2>{ 1, 1 }));
  EXPECT_EQ(triangles.Added[0].Edge % 2, 0);
  EXPECT_DOUBLE_EQ(triangles.Added[0].Part, 0.5);
  EXPECT_TRUE(triangulated(ringsOf({ square(0, 4), square(1, 3) })).Added.empty());
}

// On a lattice, where edges touch and lie on each other; turned, so that places are rounded, far
// away, too; with points that are equal up to rounding; and anywhere.
TEST(RingTriangles, AreExactForAnyRings)
{
  std::mt19937 random(1);
  const auto whole = [&](unsigned int count) { return static_cast<double>(random() % count); };
  for (int trial = 0; trial < 4000; ++trial)
  {
    const int kind = trial % 5;
    std::vector<Ring> all(1 + random() % 3);
    for (Ring& ring : all)
    {
      ring.resize(3 + random() % 8);
      const auto size = static_cast<unsigned int>(2 + random() % 6);
      for (Point<2>& x : ring)
      {
        x = { whole(size), whole(size) };
        if (kind == 1 || kind == 2)
        {
          x = { 0.8 * x[0] - 0.6 * x[1], 0.6 * x[0] + 0.8 * x[1] };
        }
        if (kind == 2)
        {
          x = { x[0] + 1e6, x[1] + 3e6 };
        }
        if (kind >= 3)
        {
          const double noise = kind == 3 ? 1e-15 : 0.1;
          x = { x[0] + noise * whole(5), x[1] + noise * whole(5) };
        }
      }
    }
    ASSERT_NEAR(areaOf(all), trapezoids(all), kind == 2 ? 1e-6 : 1e-11) << trial;
  }
}

// The work grows as the number of edges: rings side by side, over each other, in each other, about
// one point; teeth that all reach through the same lines.
TEST(RingTriangles, OfManyRings)
{
  constexpr int count = 16000;
  const double pi = std::acos(-1.0);
  std::vector<Ring> tiles;
  std::vector<Ring> strips;
  std::vector<Ring> nested;
  std::vector<Ring> fan;
  Ring teeth{ { count, -1 }, { 0, -1 } };
  for (int i = 0; i < count; ++i)
  {
    const double x = i % 128;
    const double y = i / 128; // NOLINT: the row
    tiles.push_back(
      { { 2 * x, 2 * y }, { 2 * x + 1, 2 * y }, { 2 * x + 1, 2 * y + 1 }, { 2 * x, 2 * y + 1 } });
    strips.push_back(
      { { 0, 2.0 * i }, { 100, 2.0 * i }, { 100, 2.0 * i + 1 }, { 0, 2.0 * i + 1 } });
    nested.push_back(square(-1.0 - i, 1.0 + i));
    const double angle = 2.0 * pi * i / count;
    const double next = angle + pi / count;
    fan.push_back(
      { { 0, 0 }, { std::cos(angle), std::sin(angle) }, { std::cos(next), std::sin(next) } });
    teeth.push_back({ i + 0.5, i % 2 == 0 ? 100.0 : 0.0 });
  }
  EXPECT_DOUBLE_EQ(areaOf(tiles), count);
  EXPECT_DOUBLE_EQ(areaOf(strips), 100.0 * count);
  EXPECT_DOUBLE_EQ(areaOf(nested), 4.0 * count * (count + 1) / 2);
  EXPECT_NEAR(areaOf(fan), 0.5 * count * std::sin(pi / count), 1e-9);
  EXPECT_NEAR(areaOf({ teeth }), 51.0 * count, 200.0);
}

} // namespace
} // namespace RectifiedTransport
