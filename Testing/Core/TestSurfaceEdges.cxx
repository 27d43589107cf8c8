// SPDX-License-Identifier: BSD-3-Clause
// What makes a closed surface of polygons: equal points, edges of two triangles, one orientation.
#include "Core/Solid/MergePoints.h"
#include "Core/Solid/SurfaceOrientation.h"
#include "SolidSurfaces.h"

#include <gtest/gtest.h>

#include <map>

namespace RectifiedTransport
{
namespace
{

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
  const auto count = static_cast<std::int64_t>(points.size());
  MergePoints equal(points.data()->data(), count);
  equal.Enter(0, 1000);
  equal.Enter(1000, count);
  std::map<Point<3>, std::int64_t> firsts;
  for (std::int64_t i = 0; i < count; ++i)
  {
    ASSERT_EQ(equal.First(i), firsts.emplace(points[i], i).first->second);
  }
  EXPECT_EQ(firsts.size(), 125u);
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
  const auto count = static_cast<std::int64_t>(points.size());
  MergePoints equal(points.data()->data(), count);
  equal.Enter(0, count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    ASSERT_EQ(equal.First(i), i);
  }
}

std::unique_ptr<SurfaceEdges> edgesOf(const Mesh& mesh)
{
  const auto count = static_cast<std::int64_t>(mesh.Triangles.size());
  const auto points = static_cast<std::int64_t>(mesh.Points.size());
  auto edges = std::make_unique<SurfaceEdges>(mesh.Surface().Triangles, count, points);
  edges->Count(0, count / 2);
  edges->Count(count / 2, count);
  edges->Sort(0, count / 2);
  edges->Sort(count / 2, count);
  edges->Pair(points / 2, points);
  edges->Pair(0, points / 2);
  return edges;
}

TEST(SurfaceEdges, CountsOfABox)
{
  Mesh box = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  auto edges = edgesOf(box);
  EXPECT_EQ(edges->Open(), 0);
  EXPECT_EQ(edges->NonManifold(), 0);
  EXPECT_EQ(edges->Reversed(), 0);
  const std::int64_t* ids = box.Triangles.data()->data();
  for (std::int64_t side = 0; side < 36; ++side)
  {
    const std::int64_t other = edges->Other(side);
    ASSERT_EQ(edges->Other(other), side);
    ASSERT_NE(other / 3, side / 3);
    ASSERT_EQ(ids[side], ids[other % 3 == 2 ? other - 2 : other + 1]);
  }
  std::swap(box.Triangles[5][0], box.Triangles[5][1]);
  EXPECT_EQ(edgesOf(box)->Reversed(), 3);
  box.Triangles.pop_back();
  EXPECT_EQ(edgesOf(box)->Open(), 3);
  // A fin on an edge, whose other sides are open.
  box = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  box.Points.push_back({ 2, 2, 2 });
  box.Triangles.push_back({ 0, 1, 8 });
  edges = edgesOf(box);
  EXPECT_EQ(edges->Open(), 2);
  EXPECT_EQ(edges->NonManifold(), 1);
  EXPECT_EQ(edgesOf(Mesh{ { { 0, 0, 0 } }, {} })->Open(), 0);
}

bool orient(Mesh& mesh, std::int64_t step)
{
  const auto edges = edgesOf(mesh);
  const auto count = static_cast<std::int64_t>(mesh.Triangles.size());
  SurfaceOrientation orientation(
    mesh.Points.data()->data(), mesh.Triangles.data()->data(), count, *edges);
  while (orientation.Visit(step) > 0)
  {
  }
  return orientation.IsOrientable();
}

// Turned triangles come back, each component's as most of its area.
TEST(SurfaceOrientation, MostOfTheArea)
{
  Mesh mesh = makeSphere({ 0, 0, 0 }, 2.0, 12);
  mesh.Add(makeSphere({ 0, 0, 0 }, 1.0, 9).Turned());
  mesh.Add(makeBox({ 5, 5, 5 }, { 6, 7, 8 }));
  const Mesh right = mesh;
  std::mt19937_64 random(8);
  for (const std::int64_t step : { std::int64_t{ 1 }, std::int64_t{ 100000 } })
  {
    mesh = right;
    for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
    {
      if (i == 0 || random() % 4 == 0)
      {
        std::swap(mesh.Triangles[i][1], mesh.Triangles[i][2]);
      }
    }
    EXPECT_GT(edgesOf(mesh)->Reversed(), 100);
    EXPECT_TRUE(orient(mesh, step));
    EXPECT_EQ(edgesOf(mesh)->Reversed(), 0);
    EXPECT_EQ(mesh.Triangles, right.Triangles);
  }
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
    EXPECT_TRUE(orient(mesh, 7));
    EXPECT_EQ(mesh.Triangles, turnSmall ? right.Triangles : right.Turned().Triangles);
  }
}

TEST(SurfaceOrientation, KleinBottle)
{
  const std::int64_t around = 12;
  const std::int64_t across = 10;
  Mesh mesh = makeTorus(around, across, [](double u, double v) { return Point<3>{ u, v, u * v }; });
  EXPECT_TRUE(orient(mesh, 7));
  // The last ring meets the first one mirrored.
  for (auto& triangle : mesh.Triangles)
  {
    const bool last = *std::max_element(triangle.begin(), triangle.end()) >= (around - 1) * across;
    for (std::int64_t& id : triangle)
    {
      id = last && id < across ? (across - id) % across : id;
    }
  }
  EXPECT_EQ(edgesOf(mesh)->Open(), 0);
  EXPECT_EQ(edgesOf(mesh)->NonManifold(), 0);
  EXPECT_FALSE(orient(mesh, 7));
}

} // namespace
} // namespace RectifiedTransport
