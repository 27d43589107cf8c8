// SPDX-License-Identifier: BSD-3-Clause
// What makes a closed surface of polygons: equal points, edges of two triangles, one orientation.
#include "Core/Geometry/CoincidentPoints.h"
#include "SolidSurfaces.h"
#include "Surfaces/Mesh/Repair/MergePoints.h"
#include "Surfaces/Mesh/SurfaceOrientation.h"

#include <gtest/gtest.h>

#include <map>

namespace RectifiedTransport
{
namespace
{

std::vector<std::int64_t> firstsOf(const std::vector<Point<3>>& points)
{
  std::vector<std::int64_t> firsts(points.size());
  mergePoints<3>(points, firsts.data());
  return firsts;
}

TEST(MergePoints, FirstOfEach)
{
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> digit(-2, 2);
  std::vector<Point<3>> points(3000);
  for (Point<3>& point : points)
  {
    for (double& x : point)
    {
      x = 0.1 * digit(random);
      x = x == 0.0 && random() % 2 ? -0.0 : x;
    }
  }
  const std::vector<std::int64_t> found = firstsOf(points);
  std::map<Point<3>, std::int64_t> firsts;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    ASSERT_EQ(found[i], firsts.emplace(points[i], i).first->second);
  }
  EXPECT_EQ(firsts.size(), 125u);
  EXPECT_TRUE(firstsOf({}).empty());
}

// Clusters of points within a distance, which lie on borders of boxes or not, in any order: each
// is taken for its lowest one.
TEST(MergePoints, Near)
{
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> apart(-0.45, 0.45);
  std::vector<Point<3>> centres;
  std::vector<Point<3>> points;
  const double distance = 1e-6;
  for (int i = 0; i < 2000; ++i)
  {
    const Point<3> centre{ 1e-5 * (i % 10), 1e-5 * (i / 10 % 10), 1e-5 * (i / 100) - 1e-4 };
    for (int k = 0; k < 4; ++k)
    {
      points.push_back(centre);
      for (double& x : points.back())
      {
        x += distance * apart(random);
      }
      centres.push_back(centre);
    }
  }
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::map<Point<3>, Point<3>> lowest;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    Point<3>& low = lowest.emplace(centres[i], points[i]).first->second;
    low = std::min(low, points[i]);
  }
  for (int run = 0; run < 3; ++run)
  {
    std::vector<Point<3>> mixed;
    for (const std::size_t i : order)
    {
      mixed.push_back(points[i]);
    }
    std::vector<std::int64_t> firsts(points.size());
    EXPECT_TRUE(mergeNearPoints(mixed, distance, firsts.data()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      ASSERT_EQ(mixed[static_cast<std::size_t>(firsts[i])], lowest[centres[order[i]]]) << i;
    }
    EXPECT_FALSE(mergeNearPoints(mixed, 1e-13, firsts.data()));
    EXPECT_EQ(firsts, firstsOf(mixed));
    std::shuffle(order.begin(), order.end(), random);
  }
}

// Points that differ in the last bit are different; so are a million in a corner of the bounds,
// which by pairs would take hours.
TEST(MergePoints, ManyInACorner)
{
  std::vector<Point<3>> points{ { 1e9, 1e9, 1e9 }, { 1.0, 1.0, 1.0 },
    { std::nextafter(1.0, 2.0), 1.0, 1.0 } };
  for (int i = 0; i < 1000000; ++i)
  {
    points.push_back({ i % 100 * 1e-6, i / 100 % 100 * 1e-6, i / 10000 * 1e-6 });
  }
  std::vector<std::int64_t> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  EXPECT_EQ(firstsOf(points), numbers);
}

TEST(SurfaceEdges, CountsOfABox)
{
  Mesh box = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  const SurfaceEdges closed(box.Surface());
  EXPECT_EQ(closed.Open(), 0);
  EXPECT_EQ(closed.NonManifold(), 0);
  EXPECT_EQ(closed.Reversed(), 0);
  const std::int64_t* ids = box.Triangles.data()->data();
  for (std::int64_t side = 0; side < 36; ++side)
  {
    const std::int64_t other = closed.Other(side);
    ASSERT_EQ(closed.Other(other), side);
    ASSERT_NE(other / 3, side / 3);
    ASSERT_EQ(ids[side], ids[other % 3 == 2 ? other - 2 : other + 1]);
  }
  std::swap(box.Triangles[5][0], box.Triangles[5][1]);
  EXPECT_EQ(SurfaceEdges(box.Surface()).Reversed(), 3);
  box.Triangles.pop_back();
  EXPECT_EQ(SurfaceEdges(box.Surface()).Open(), 3);
  // A fin on an edge, whose other sides are open.
  box = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  box.Points.push_back({ 2, 2, 2 });
  box.Triangles.push_back({ 0, 1, 8 });
  const SurfaceEdges withFin(box.Surface());
  EXPECT_EQ(withFin.Open(), 2);
  EXPECT_EQ(withFin.NonManifold(), 1);
  const Mesh point{ { { 0, 0, 0 } }, {} };
  EXPECT_EQ(SurfaceEdges(point.Surface()).Open(), 0);
}

// Edges are as many and the same on any threads, and two points of very many triangles are no more
// work than others.
TEST(SurfaceEdges, ThreadsAndFans)
{
  constexpr std::int64_t around = 50000;
  Mesh fans;
  for (std::int64_t i = 0; i < around; ++i)
  {
    fans.Points.push_back({ static_cast<double>(i), 0.0, 0.0 });
    const std::int64_t next = (i + 1) % around;
    fans.Triangles.push_back({ i, next, around });
    fans.Triangles.push_back({ next, i, around + 1 });
  }
  fans.Points.resize(around + 2);
  std::swap(fans.Triangles[7][0], fans.Triangles[7][1]);
  const SurfaceEdges serial(fans.Surface(), SerialExecutor());
  const SurfaceEdges parallel(fans.Surface(), OpenMPExecutor());
  EXPECT_EQ(serial.Open() + serial.NonManifold(), 0);
  EXPECT_EQ(serial.Reversed(), 3);
  EXPECT_EQ(parallel.Reversed(), 3);
  for (std::int64_t side = 0; side < 6 * around; ++side)
  {
    ASSERT_EQ(serial.Other(side), parallel.Other(side));
  }
  fans.Triangles.pop_back();
  EXPECT_EQ(SurfaceEdges(fans.Surface(), OpenMPExecutor()).Open(), 3);
}

// In place, as in other memory.
bool orient(Mesh& mesh)
{
  const SurfaceEdges edges(mesh.Surface());
  auto elsewhere = mesh.Triangles;
  const bool orientable =
    orientSurface(mesh.Surface(), edges, elsewhere.data()->data()).IsOrientable;
  EXPECT_EQ(
    orientSurface(mesh.Surface(), edges, mesh.Triangles.data()->data()).IsOrientable, orientable);
  EXPECT_EQ(mesh.Triangles, elsewhere);
  return orientable;
}

// Turned triangles come back, each component's as most of its area.
TEST(SurfaceOrientation, MostOfTheArea)
{
  Mesh mesh = makeSphere({ 0, 0, 0 }, 2.0, 12);
  mesh.Add(makeSphere({ 0, 0, 0 }, 1.0, 9).Turned());
  mesh.Add(makeBox({ 5, 5, 5 }, { 6, 7, 8 }));
  const Mesh right = mesh;
  std::mt19937_64 random(8);
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    if (i == 0 || random() % 4 == 0)
    {
      std::swap(mesh.Triangles[i][1], mesh.Triangles[i][2]);
    }
  }
  EXPECT_GT(SurfaceEdges(mesh.Surface()).Reversed(), 100);
  EXPECT_TRUE(orient(mesh));
  EXPECT_EQ(SurfaceEdges(mesh.Surface()).Reversed(), 0);
  EXPECT_EQ(mesh.Triangles, right.Triangles);
}

// A few large triangles have more of the area than many small ones.
TEST(SurfaceOrientation, AreaIsNotCount)
{
  constexpr std::int64_t around = 12;
  constexpr std::int64_t across = 4;
  // A square tube that closes; its last ring is far from all others.
  const Mesh right = makeTorus(around, across, [](double u, double v) {
    const double x = u > 0.9 ? 10.0 : 0.01 * u;
    return Point<3>{ x, v < 0.5 ? 0.0 : 1.0, v > 0.2 && v < 0.7 ? 1.0 : 0.0 };
  });
  const std::size_t small = 2 * across * (around - 2);
  ASSERT_EQ(right.Triangles.size(), small + 4 * across);
  for (const bool turnSmall : { true, false })
  {
    Mesh mesh = right;
    for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
    {
      if ((i < small) == turnSmall)
      {
        std::swap(mesh.Triangles[i][1], mesh.Triangles[i][2]);
      }
    }
    EXPECT_TRUE(orient(mesh));
    EXPECT_EQ(mesh.Triangles, turnSmall ? right.Triangles : right.Turned().Triangles);
  }
}

TEST(SurfaceOrientation, KleinBottle)
{
  const std::int64_t around = 12;
  const std::int64_t across = 10;
  Mesh mesh = makeTorus(around, across, [](double u, double v) { return Point<3>{ u, v, u * v }; });
  EXPECT_TRUE(orient(mesh));
  // The last ring meets the first one mirrored.
  for (auto& triangle : mesh.Triangles)
  {
    const bool last = *std::max_element(triangle.begin(), triangle.end()) >= (around - 1) * across;
    for (std::int64_t& id : triangle)
    {
      id = last && id < across ? (across - id) % across : id;
    }
  }
  EXPECT_EQ(SurfaceEdges(mesh.Surface()).Open(), 0);
  EXPECT_EQ(SurfaceEdges(mesh.Surface()).NonManifold(), 0);
  EXPECT_FALSE(orient(mesh));
}

// Each step queries IsCancelled before it is done, and stops.
TEST(ClosedSurface, Cancelled)
{
  Mesh mesh = makeSphere({ 0, 0, 0 }, 1.0, 300);
  const SerialExecutor executor;
  for (const double from : { 0.0, 0.3, 0.8 })
  {
    double reached = -1.0;
    const Context context(
      executor, [&reached](double done) { reached = done; },
      [&reached, from]() { return reached >= from; });
    std::vector<std::int64_t> firsts(mesh.Points.size());
    EXPECT_THROW(mergePoints<3>(mesh.Points, firsts.data(), context), Cancelled);
    EXPECT_GE(reached, from);
    reached = -1.0;
    EXPECT_THROW(SurfaceEdges(mesh.Surface(), context), Cancelled);
    EXPECT_GE(reached, from);
    reached = -1.0;
    EXPECT_THROW(orientSurface(mesh.Surface(), SurfaceEdges(mesh.Surface()),
                   mesh.Triangles.data()->data(), context),
      Cancelled);
    EXPECT_GE(reached, from);
  }
}

} // namespace
} // namespace RectifiedTransport
