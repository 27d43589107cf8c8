// SPDX-License-Identifier: BSD-3-Clause
// Surfaces with points and triangles of no area: which of them are disks, what is left out and
// merged, that the area is kept, and where points and triangles go.
#include "SolidSurfaces.h"
#include "Surfaces/Mesh/Repair/RepairedDisk.h"
#include "TestMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

namespace RectifiedTransport
{
namespace
{

constexpr double floatRounding = 4.0 * 1.1920929e-7;

// The unit square in the plane, of n x n squares of two triangles; corners are x + y (n + 1).
Mesh makeSquare(std::int64_t n)
{
  Mesh mesh;
  for (std::int64_t y = 0; y <= n; ++y)
  {
    for (std::int64_t x = 0; x <= n; ++x)
    {
      mesh.Points.push_back({ static_cast<double>(x) / static_cast<double>(n),
        static_cast<double>(y) / static_cast<double>(n), 0.0 });
      if (x < n && y < n)
      {
        const std::int64_t i = x + y * (n + 1);
        mesh.Triangles.push_back({ i, i + 1, i + n + 2 });
        mesh.Triangles.push_back({ i, i + n + 2, i + n + 1 });
      }
    }
  }
  return mesh;
}

// Each triangle with points of its own.
Mesh makeSoup(const Mesh& mesh)
{
  Mesh soup;
  for (const auto& triangle : mesh.Triangles)
  {
    const auto first = static_cast<std::int64_t>(soup.Points.size());
    for (const std::int64_t id : triangle)
    {
      soup.Points.push_back(mesh.Points[static_cast<std::size_t>(id)]);
    }
    soup.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return soup;
}

std::int64_t addPoint(Mesh& mesh, const Point<3>& point)
{
  mesh.Points.push_back(point);
  return static_cast<std::int64_t>(mesh.Points.size()) - 1;
}

Point<3> between(const Mesh& mesh, std::int64_t a, std::int64_t b, double part)
{
  Point<3> point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    point[axis] = (1.0 - part) * mesh.Points[static_cast<std::size_t>(a)][axis] +
      part * mesh.Points[static_cast<std::size_t>(b)][axis];
  }
  return point;
}

double areaOf(const RepairedDisk& disk)
{
  return disk.Mesh().Area() * disk.Mesh().Unit() * disk.Mesh().Unit();
}

void expectRepairs(
  const RepairedDisk& disk, std::int64_t unused, std::int64_t flat, std::int64_t merged)
{
  EXPECT_EQ(disk.Repairs().UnusedPoints, unused);
  EXPECT_EQ(disk.Repairs().FlatTriangles, flat);
  EXPECT_EQ(disk.Repairs().MergedPoints, merged);
}

// Whether each triangle of the disk lies in the given one, and has its corners' coordinates.
void expectGiven(const Mesh& mesh, const RepairedDisk& disk, double rounding = 0.0)
{
  const GivenTriangles given(disk, mesh.Triangles[0].data());
  double shares = 0.0;
  std::set<std::int64_t> numbers;
  for (std::int64_t i = 0; i < given.Surface().NumberOfTriangles; ++i)
  {
    shares += given.AreaShares()[i];
    numbers.insert(given.Given(i));
  }
  EXPECT_NEAR(shares, 1.0, 1e-12);
  EXPECT_EQ(static_cast<std::int64_t>(numbers.size()), given.Surface().NumberOfTriangles);
  for (std::int64_t t = 0; t < disk.Mesh().NumberOfTriangles(); ++t)
  {
    EXPECT_EQ(numbers.count(disk.GivenTriangle(t)), 1u);
    const auto corners = disk.GivenCorners(t);
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_EQ(disk.PointOf(corners[i]), disk.Mesh().Triangle(t)[i]);
      const std::int64_t first = corners[i];
      const auto& all = mesh.Triangles[static_cast<std::size_t>(disk.GivenTriangle(t))];
      // Within the given triangle's bounds.
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const auto at = [&](std::int64_t id) {
          return mesh.Points[static_cast<std::size_t>(id)][axis];
        };
        const auto range = std::minmax({ at(all[0]), at(all[1]), at(all[2]) });
        EXPECT_GE(at(first), range.first - 1e-12 - rounding);
        EXPECT_LE(at(first), range.second + 1e-12 + rounding);
      }
    }
  }
}

std::string defectOf(const Mesh& mesh, double rounding = 0.0)
{
  try
  {
    const RepairedDisk disk(mesh.Surface(), rounding);
    return "none";
  }
  catch (const NotADisk& defect)
  {
    return defect.what();
  }
}

TEST(RepairedDisk, ADiskStaysAsItIs)
{
  const Mesh mesh = makeSquare(3);
  const RepairedDisk disk(mesh.Surface(), floatRounding);
  EXPECT_FALSE(disk.Repairs().Any());
  expectRepairs(disk, 0, 0, 0);
  EXPECT_EQ(disk.Mesh().NumberOfPoints(), 16);
  EXPECT_EQ(disk.PointOf(7), 7);
  EXPECT_EQ(disk.GivenTriangle(5), 5);
  EXPECT_EQ(disk.NumberOfGivenPoints(), 16);
  expectGiven(mesh, disk);
}

// A closed surface that was cut open has points twice along the cut.
TEST(RepairedDisk, ACutStaysOpen)
{
  constexpr std::int64_t around = 8;
  Mesh tube;
  for (std::int64_t i = 0; i <= around; ++i)
  {
    const double angle = 2.0 * pi * static_cast<double>(i % around) / static_cast<double>(around);
    for (const double z : { 0.0, 1.0 })
    {
      tube.Points.push_back({ std::cos(angle), std::sin(angle), z });
    }
    if (i < around)
    {
      tube.Triangles.push_back({ 2 * i, 2 * i + 2, 2 * i + 3 });
      tube.Triangles.push_back({ 2 * i, 2 * i + 3, 2 * i + 1 });
    }
  }
  // Also where something else has to be repaired.
  tube.Points.push_back({ 7, 7, 7 });
  tube.Triangles.push_back({ 3, 3, 5 });
  const RepairedDisk disk(tube.Surface(), floatRounding);
  expectRepairs(disk, 1, 1, 0);
  EXPECT_EQ(disk.Mesh().Boundary().size(), 18u);
  EXPECT_EQ(disk.PointOf(18), -1);
}

// Where a flat triangle was, its points may be there twice: a crack from the boundary inwards.
TEST(RepairedDisk, CracksAreClosed)
{
  Mesh mesh = makeSquare(4);
  std::vector<std::int64_t> twins;
  for (const std::int64_t id : { 2, 7 })
  {
    twins.push_back(addPoint(mesh, mesh.Points[static_cast<std::size_t>(id)]));
  }
  for (auto& triangle : mesh.Triangles) // those on the right have the twins
  {
    double x = 0.0;
    for (const std::int64_t id : triangle)
    {
      x += mesh.Points[static_cast<std::size_t>(id)][0] / 3.0;
    }
    if (x > 0.5)
    {
      std::replace(triangle.begin(), triangle.end(), std::int64_t{ 2 }, twins[0]);
      std::replace(triangle.begin(), triangle.end(), std::int64_t{ 7 }, twins[1]);
    }
  }
  // As such it may be a cut that somebody has made.
  expectRepairs(RepairedDisk(mesh.Surface(), 0.0), 0, 0, 0);
  const std::int64_t flat = addPoint(mesh, { 0.1, 1.0, 0.0 });
  mesh.Triangles.push_back({ 21, 20, flat });
  const RepairedDisk disk(mesh.Surface(), 0.0);
  expectRepairs(disk, 0, 1, 2);
  EXPECT_EQ(disk.Mesh().Boundary().size(), 17u);
  expectGiven(mesh, disk);
}

TEST(RepairedDisk, UnusedPoints)
{
  Mesh mesh = makeSquare(4);
  mesh.Points.insert(mesh.Points.begin(), { 9, 9, 9 });
  for (auto& triangle : mesh.Triangles)
  {
    for (std::int64_t& id : triangle)
    {
      ++id;
    }
  }
  addPoint(mesh, { -5, 0, 0 });
  const RepairedDisk disk(mesh.Surface(), 0.0);
  expectRepairs(disk, 2, 0, 0);
  EXPECT_EQ(disk.PointOf(0), -1);
  EXPECT_EQ(disk.PointOf(26), -1);
  EXPECT_EQ(disk.PointOf(1), 0);
  EXPECT_NEAR(areaOf(disk), 1.0, 1e-14);
  expectGiven(mesh, disk);
}

// Points on the diagonals of squares, with a flat triangle on one side of each.
Mesh withPointsOnDiagonals(std::int64_t n, int points)
{
  const Mesh square = makeSquare(n);
  Mesh mesh;
  mesh.Points = square.Points;
  for (std::size_t t = 0; t < square.Triangles.size(); t += 2)
  {
    const auto [a, b, d] = square.Triangles[t]; // the diagonal is from a to d
    const std::int64_t e = square.Triangles[t + 1][2];
    mesh.Triangles.push_back({ a, b, d });
    std::int64_t last = a;
    for (int i = 1; i <= points; ++i)
    {
      const std::int64_t next =
        addPoint(mesh, between(square, a, d, static_cast<double>(i) / (points + 1.0)));
      mesh.Triangles.push_back({ last, d, next }); // flat, each on the next one's longest side
      mesh.Triangles.push_back({ last, next, e });
      last = next;
    }
    mesh.Triangles.push_back({ last, d, e });
  }
  return mesh;
}

TEST(RepairedDisk, PointsOnSides)
{
  for (const int points : { 1, 2, 5 })
  {
    SCOPED_TRACE(points);
    const Mesh mesh = withPointsOnDiagonals(3, points);
    const RepairedDisk disk(mesh.Surface(), 0.0);
    expectRepairs(disk, 0, 9 * points, 0);
    EXPECT_EQ(disk.Mesh().NumberOfPoints(), 16 + 9 * points);
    EXPECT_EQ(disk.Mesh().NumberOfTriangles(), 18 + 18 * points);
    EXPECT_NEAR(areaOf(disk), 1.0, 1e-14);
    expectGiven(mesh, disk);
  }
}

// However a plane lies, and whatever the order of the triangles.
TEST(RepairedDisk, PointsOnSidesAnywhere)
{
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i)
  {
    SCOPED_TRACE(i);
    Mesh mesh = withPointsOnDiagonals(4, 1 + i % 3);
    std::shuffle(mesh.Triangles.begin(), mesh.Triangles.end(), random);
    for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3)
    {
      std::swap(mesh.Triangles[t][0], mesh.Triangles[t][1]); // of another orientation
    }
    const double angle = 0.3 * i;
    mesh = mesh.Mapped([angle](const Point<3>& p) {
      const double x = std::cos(angle) * p[0] - std::sin(angle) * p[1];
      const double y = std::sin(angle) * p[0] + std::cos(angle) * p[1];
      return Point<3>{ 3.0 * x + 7.0, 3.0 * std::cos(0.7) * y - 2.0, 3.0 * std::sin(0.7) * y };
    });
    const RepairedDisk disk(mesh.Surface(), 0.0);
    EXPECT_NEAR(areaOf(disk), 9.0, 1e-11);
    // Rounding may give a triangle some area.
    EXPECT_LE(disk.Repairs().FlatTriangles, 16 * (1 + i % 3));
    expectGiven(mesh, disk, 1e-12);
  }
}

TEST(RepairedDisk, DegenerateTrianglesOfTheBoundary)
{
  Mesh mesh = makeSquare(3);
  const std::int64_t inside = addPoint(mesh, between(mesh, 0, 1, 0.5));
  mesh.Triangles.push_back({ 1, 0, inside }); // its longest side is inside
  const std::int64_t tip = addPoint(mesh, { 0.5, 1.0, 0.0 });
  mesh.Triangles.push_back({ 14, 13, tip });
  const std::int64_t beyond = addPoint(mesh, { 1.25, 1.0, 0.0 });
  mesh.Triangles.push_back({ 15, 14, beyond }); // a spike
  const RepairedDisk disk(mesh.Surface(), 0.0);
  expectRepairs(disk, 0, 3, 0);
  EXPECT_NEAR(areaOf(disk), 1.0, 1e-14);
  EXPECT_GE(disk.PointOf(inside), 0);
  EXPECT_GE(disk.PointOf(tip), 0);
  EXPECT_EQ(disk.PointOf(beyond), disk.PointOf(15)); // the nearest that is left
  expectGiven(mesh, disk);
}

// As Slice makes where a plane passes through points: several points at one place, and triangles
// among them.
TEST(RepairedDisk, PointsAtOnePlaceThatEdgesJoin)
{
  Mesh mesh = makeSquare(4);
  // Point 12, in the middle, becomes three; the triangles about it use them in turn.
  const std::int64_t second = addPoint(mesh, mesh.Points[12]);
  const std::int64_t third = addPoint(mesh, mesh.Points[12]);
  std::vector<std::size_t> about;
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    if (std::count(mesh.Triangles[t].begin(), mesh.Triangles[t].end(), 12) > 0)
    {
      about.push_back(t);
    }
  }
  ASSERT_EQ(about.size(), 6u);
  const auto use = [&](std::size_t triangle, std::int64_t point) {
    auto& ids = mesh.Triangles[triangle];
    std::replace(ids.begin(), ids.end(), std::int64_t{ 12 }, point);
  };
  // Those right of the middle, with a flat triangle where they meet the others.
  std::int64_t moved = 0;
  for (const std::size_t t : about)
  {
    double x = 0.0;
    for (const std::int64_t id : mesh.Triangles[t])
    {
      x += mesh.Points[static_cast<std::size_t>(id)][0] / 3.0;
    }
    if (x > 0.5)
    {
      use(t, second);
      ++moved;
    }
  }
  ASSERT_EQ(moved, 3);
  mesh.Triangles.push_back({ 12, second, 7 });
  mesh.Triangles.push_back({ 12, third, second });
  mesh.Triangles.push_back({ third, 17, second });
  mesh.Triangles.push_back({ 12, 17, third });
  const RepairedDisk disk(mesh.Surface(), floatRounding);
  expectRepairs(disk, 0, 4, 2);
  EXPECT_EQ(disk.PointOf(second), disk.PointOf(12));
  EXPECT_EQ(disk.PointOf(third), disk.PointOf(12));
  EXPECT_EQ(disk.Mesh().NumberOfPoints(), 25);
  EXPECT_NEAR(areaOf(disk), 1.0, 1e-14);
  expectGiven(mesh, disk);
  // The same where rounding keeps them apart by some bits.
  mesh.Points[static_cast<std::size_t>(second)][0] += 3e-8;
  mesh.Points[static_cast<std::size_t>(third)][2] -= 3e-8;
  const RepairedDisk rounded(mesh.Surface(), floatRounding);
  EXPECT_NEAR(areaOf(rounded), 1.0, 1e-6);
}

TEST(RepairedDisk, TrianglesWithPointsOfTheirOwn)
{
  const Mesh square = makeSquare(5);
  const Mesh soup = makeSoup(square);
  const RepairedDisk disk(soup.Surface(), 0.0);
  expectRepairs(disk, 0, 0, 150 - 36);
  EXPECT_EQ(disk.Mesh().NumberOfPoints(), 36);
  expectGiven(soup, disk);
  // Each triangle keeps its own points, as their values may differ.
  for (std::int64_t t = 0; t < disk.Mesh().NumberOfTriangles(); ++t)
  {
    for (const std::int64_t corner : disk.GivenCorners(t))
    {
      EXPECT_EQ(corner / 3, disk.GivenTriangle(t));
    }
  }
  // Also where rounding differs, in whatever direction.
  Mesh rounded = makeSoup(square.Mapped([](const Point<3>& p) {
    return Point<3>{ p[0] - 0.4, 0.6 * p[1] - 0.3, 0.8 * p[1] };
  }));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> error(-1e-7, 1e-7);
  for (Point<3>& point : rounded.Points)
  {
    for (double& x : point)
    {
      x += error(random);
    }
  }
  const RepairedDisk joined(rounded.Surface(), floatRounding);
  expectRepairs(joined, 0, 0, 150 - 36);
  EXPECT_NEAR(areaOf(joined), 1.0, 1e-6);
  EXPECT_NE(defectOf(rounded).find("has 50 components"), std::string::npos);
  // What is wrong once they are joined, not that they are apart.
  EXPECT_NE(
    defectOf(makeSoup(makeSphere({ 0, 0, 0 }, 1.0, 3))).find("is closed"), std::string::npos);
}

TEST(RepairedDisk, PartsWithoutArea)
{
  Mesh mesh = makeSquare(3);
  const std::int64_t first = addPoint(mesh, { 4, 4, 4 });
  addPoint(mesh, { 5, 5, 5 });
  addPoint(mesh, { 7, 7, 7 });
  addPoint(mesh, { 8, 8, 8 });
  mesh.Triangles.push_back({ first, first + 1, first + 2 });
  mesh.Triangles.push_back({ first + 2, first + 1, first + 3 });
  const RepairedDisk disk(mesh.Surface(), 0.0);
  expectRepairs(disk, 0, 2, 0);
  EXPECT_EQ(disk.PointOf(first), -1);
  EXPECT_EQ(disk.PointOf(first + 3), -1);
  EXPECT_NEAR(areaOf(disk), 1.0, 1e-14);
}

TEST(RepairedDisk, WhatIsNone)
{
  Mesh line = makeSquare(2);
  line = line.Mapped([](const Point<3>& p) { return Point<3>{ p[0], 2.0 * p[0], -p[0] }; });
  EXPECT_EQ(defectOf(line),
    "has 8 triangles without area, the first is triangle 0; move their points apart");
  Mesh parts = makeSquare(2);
  parts.Add(makeSquare(2).Mapped([](const Point<3>& p) {
    return Point<3>{ p[0] + 3.0, p[1], p[2] };
  }));
  EXPECT_EQ(defectOf(parts, floatRounding).find("has 2 components"), 0u);
  EXPECT_EQ(defectOf(makeSphere({ 1, 2, 3 }, 4.0, 3), floatRounding).find("is closed"), 0u);
  EXPECT_EQ(defectOf({}), "has no triangles");
  // Numbers are those of the given points: here two sheets touch at one.
  Mesh touching = makeSquare(4);
  touching.Points.insert(touching.Points.begin(), { 9, 9, 9 });
  for (auto& triangle : touching.Triangles)
  {
    for (std::int64_t& id : triangle)
    {
      ++id;
    }
  }
  // Its opposite corners become one.
  for (auto& triangle : touching.Triangles)
  {
    std::replace(triangle.begin(), triangle.end(), std::int64_t{ 25 }, std::int64_t{ 1 });
  }
  EXPECT_NE(defectOf(touching).find("the first is point 1;"), std::string::npos)
    << defectOf(touching);
  Mesh notFinite = makeSquare(2);
  notFinite.Points[4][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(defectOf(notFinite).find("has 1 point that is not finite"), 0u);
}

// A flat triangle whose side cannot be flipped, as its far points have an edge already.
TEST(RepairedDisk, AnEdgeIsNotMadeTwice)
{
  const Mesh mesh{ { { 0, 0, 0 }, { 2, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 3, 2, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 3, 4 } } };
  EXPECT_EQ(defectOf(mesh),
    "has 1 triangle without area, the first is triangle 0; move their points apart");
}

// Coordinates whose squares no double is.
TEST(RepairedDisk, WhateverTheSize)
{
  for (const double scale : { 1e-300, 1e-200, 1e200, 1e300 })
  {
    SCOPED_TRACE(scale);
    const Mesh mesh = withPointsOnDiagonals(3, 2).Mapped([scale](const Point<3>& p) {
      return Point<3>{ scale * p[0], scale * p[1], scale * p[2] };
    });
    const RepairedDisk disk(mesh.Surface(), floatRounding * scale);
    expectRepairs(disk, 0, 18, 0);
  }
}

TEST(RepairedDisk, Cancelled)
{
  Context context;
  context.IsCancelled = []() { return true; };
  EXPECT_THROW(RepairedDisk(withPointsOnDiagonals(40, 2).Surface(), 0.0, context), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
