// SPDX-License-Identifier: BSD-3-Clause
// Which surfaces are disks, what is said of the others, and what a disk knows of itself: one
// orientation, shares of the area, the boundary in order.
#include "SolidSurfaces.h"
#include "Surfaces/Mesh/DiskMesh.h"
#include "TestMesh.h"
#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace RectifiedTransport
{
namespace
{

using Ids = std::vector<std::int64_t>;

// Squares of two triangles each in the plane, `columns` by `rows`, those that `skip` tells left
// out; their corners are id = x + y (columns + 1).
Mesh makeGrid(std::int64_t columns, std::int64_t rows,
  const std::function<bool(std::int64_t, std::int64_t)>& skip = {})
{
  Mesh mesh;
  for (std::int64_t y = 0; y <= rows; ++y)
  {
    for (std::int64_t x = 0; x <= columns; ++x)
    {
      mesh.Points.push_back({ static_cast<double>(x), static_cast<double>(y), 0.0 });
      if (x < columns && y < rows && !(skip && skip(x, y)))
      {
        const std::int64_t i = x + y * (columns + 1);
        mesh.Triangles.push_back({ i, i + 1, i + columns + 2 });
        mesh.Triangles.push_back({ i, i + columns + 2, i + columns + 1 });
      }
    }
  }
  return mesh;
}

// A band of squares that closes, with its ends mirrored or not: `around` squares of two triangles.
Mesh makeBand(std::int64_t around, bool mirrored)
{
  Mesh mesh;
  for (std::int64_t i = 0; i < around; ++i)
  {
    const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(around);
    const double turn = mirrored ? 0.5 * angle : 0.0;
    for (const double across : { -0.5, 0.5 })
    {
      const double radius = 2.0 + across * std::cos(turn);
      mesh.Points.push_back(
        { radius * std::cos(angle), radius * std::sin(angle), across * std::sin(turn) });
    }
    const bool cross = mirrored && i + 1 == around;
    const std::int64_t next = 2 * ((i + 1) % around);
    const std::int64_t low = next + (cross ? 1 : 0);
    const std::int64_t high = next + (cross ? 0 : 1);
    mesh.Triangles.push_back({ 2 * i, low, high });
    mesh.Triangles.push_back({ 2 * i, high, 2 * i + 1 });
  }
  return mesh;
}

Mesh makeClosedTorus()
{
  return makeTorus(8, 6, [](double u, double v) {
    const double radius = 3.0 + std::cos(2.0 * pi * v);
    return Point<3>{ radius * std::cos(2.0 * pi * u), radius * std::sin(2.0 * pi * u),
      std::sin(2.0 * pi * v) };
  });
}

// Without its last square: four points on the boundary.
Mesh makeOpenTorus()
{
  Mesh mesh = makeClosedTorus();
  mesh.Triangles.resize(mesh.Triangles.size() - 2);
  return mesh;
}

Mesh replaced(Mesh mesh, std::int64_t point, std::int64_t by)
{
  for (auto& triangle : mesh.Triangles)
  {
    std::replace(triangle.begin(), triangle.end(), point, by);
  }
  return mesh;
}

Mesh withoutUnused(const Mesh& mesh)
{
  Mesh used;
  Ids numbers(mesh.Points.size(), -1);
  for (auto triangle : mesh.Triangles)
  {
    for (std::int64_t& id : triangle)
    {
      std::int64_t& number = numbers[static_cast<std::size_t>(id)];
      if (number < 0)
      {
        number = static_cast<std::int64_t>(used.Points.size());
        used.Points.push_back(mesh.Points[static_cast<std::size_t>(id)]);
      }
      id = number;
    }
    used.Triangles.push_back(triangle);
  }
  return used;
}

// Expects that a mesh is no disk, for this reason, and with this in the message.
void expectDefect(const Mesh& mesh, DiskDefect defect, std::int64_t count, std::int64_t first,
  const std::string& text)
{
  SCOPED_TRACE(text);
  try
  {
    const DiskMesh disk(mesh.Surface());
    ADD_FAILURE() << "is a disk";
  }
  catch (const NotADisk& found)
  {
    EXPECT_EQ(found.Defect(), defect);
    EXPECT_EQ(found.Count(), count);
    EXPECT_EQ(found.First(), first);
    EXPECT_NE(std::string(found.what()).find(text), std::string::npos) << found.what();
  }
}

TEST(DiskMesh, PointsAndTriangles)
{
  Mesh mesh = makeGrid(3, 2);
  const Mesh whole = mesh;
  mesh.Points[5][1] = std::numeric_limits<double>::infinity();
  expectDefect(mesh, DiskDefect::PointsNotFinite, 1, 5,
    "has 1 point that is not finite; the first is point 5");
  mesh.Points[3][2] = std::nan("");
  mesh.Points[5] = { -HUGE_VAL, HUGE_VAL, HUGE_VAL };
  expectDefect(mesh, DiskDefect::PointsNotFinite, 2, 3,
    "has 2 points that are not finite; the first is point 3");
  expectDefect({ whole.Points, {} }, DiskDefect::NoTriangles, 0, -1, "has no triangles");
  expectDefect({}, DiskDefect::NoTriangles, 0, -1, "has no triangles");

  mesh = whole;
  mesh.Points[1] = mesh.Points[0]; // of squares 0 and 1
  expectDefect(mesh, DiskDefect::TrianglesWithoutArea, 1, 0,
    "has 1 triangle without area, the first is triangle 0");
  mesh = whole;
  mesh.Triangles[7] = { 4, 4, 9 };
  mesh.Triangles[9] = { 0, 1, 2 };
  expectDefect(mesh, DiskDefect::TrianglesWithoutArea, 2, 7,
    "has 2 triangles without area, the first is triangle 7");
  mesh = makeGrid(2, 2);
  for (Point<3>& point : mesh.Points)
  {
    point = { 7.0, 7.0, 7.0 };
  }
  expectDefect(mesh, DiskDefect::TrianglesWithoutArea, 8, 0, "has 8 triangles without area");

  mesh = whole;
  mesh.Points.push_back({ 1, 2, 3 });
  expectDefect(mesh, DiskDefect::UnusedPoints, 1, 12,
    "has 1 point that is in no triangle, the first is point 12");
  mesh = makeGrid(3, 3, [](std::int64_t x, std::int64_t y) { return x > 0 || y > 0; });
  expectDefect(mesh, DiskDefect::UnusedPoints, 12, 2, "has 12 points that are in no triangle");
}

TEST(DiskMesh, Edges)
{
  Mesh mesh = makeGrid(3, 2);
  mesh.Points.push_back({ 1, 1, 1 });
  mesh.Triangles.push_back({ 0, 5, 12 }); // on the diagonal of the first square
  expectDefect(mesh, DiskDefect::NonManifoldEdges, 1, -1,
    "has 1 non-manifold edge; every edge must be one of at most two triangles");
  mesh.Triangles.push_back({ 1, 6, 12 });
  expectDefect(mesh, DiskDefect::NonManifoldEdges, 2, -1, "has 2 non-manifold edges");

  mesh = makeGrid(3, 2);
  mesh.Add(makeGrid(2, 2).Mapped([](const Point<3>& p) { return Point<3>{ p[0], p[1], 1.0 }; }));
  expectDefect(mesh, DiskDefect::Components, 2, -1, "has 2 components that no edges join");
  // Squares that have corners in common only.
  mesh =
    makeGrid(4, 4, [](std::int64_t x, std::int64_t y) { return x != y || (x != 1 && x != 2); });
  expectDefect(withoutUnused(mesh), DiskDefect::Components, 2, -1, "has 2 components");
  // Each triangle with points of its own; equal coordinates do not join them.
  const Mesh grid = makeGrid(3, 2);
  Mesh apart;
  for (const auto& triangle : grid.Triangles)
  {
    const auto first = static_cast<std::int64_t>(apart.Points.size());
    for (const std::int64_t id : triangle)
    {
      apart.Points.push_back(grid.Points[static_cast<std::size_t>(id)]);
    }
    apart.Triangles.push_back({ first, first + 1, first + 2 });
  }
  expectDefect(apart, DiskDefect::Components, 12, -1, "has 12 components");
}

TEST(DiskMesh, OtherSurfaces)
{
  expectDefect(
    makeBand(7, true), DiskDefect::NotOrientable, 1, -1, "is not orientable: it has one side only");
  expectDefect(makeBand(7, false), DiskDefect::BoundaryLoops, 2, -1, "has 2 boundary loops");
  const auto holes = [](std::int64_t x, std::int64_t y) { return x % 2 == 1 && y == 1; };
  expectDefect(makeGrid(7, 3, holes), DiskDefect::BoundaryLoops, 4, -1, "has 4 boundary loops");
  expectDefect(makeSphere({ 1, 2, 3 }, 4.0, 5), DiskDefect::Closed, 0, -1, "is closed");
  expectDefect(makeClosedTorus(), DiskDefect::Closed, 0, -1, "is closed");
  expectDefect(makeOpenTorus(), DiskDefect::Handles, 1, -1, "has 1 handle, as a torus has one");
}

// Two tori joined along the squares that they miss, the second one's square mirrored, and one of
// them open elsewhere.
TEST(DiskMesh, TwoHandles)
{
  const Mesh first = makeOpenTorus();
  const auto points = static_cast<std::int64_t>(first.Points.size());
  // The corners of the last square, in order: rows 7 and 0 of 6 points.
  const Ids square{ 47, 5, 0, 42 };
  Mesh mesh = first;
  mesh.Add(first.Mapped([](const Point<3>& p) { return Point<3>{ 9.0 - p[0], p[1], p[2] }; }));
  for (const std::size_t i : { 0u, 1u, 2u, 3u })
  {
    mesh = replaced(mesh, points + square[i], square[3 - i]);
  }
  expectDefect(withoutUnused(mesh), DiskDefect::Closed, 0, -1, "is closed");
  mesh.Triangles.erase(mesh.Triangles.begin() + 40, mesh.Triangles.begin() + 42);
  expectDefect(withoutUnused(mesh), DiskDefect::Handles, 2, -1, "has 2 handles");
}

// Parts that are joined by edges elsewhere.
TEST(DiskMesh, PointsWherePartsTouch)
{
  // A strip whose ends have a corner in common, and one whose ends have two.
  expectDefect(withoutUnused(replaced(makeGrid(8, 1), 8, 0)), DiskDefect::NonManifoldPoints, 1, 0,
    "has 1 point where parts of it touch that no edges join, the first is point 0");
  expectDefect(replaced(makeGrid(5, 4,
                          [](std::int64_t x, std::int64_t y) {
                            return (x == 1 && y == 1) || (x == 2 && y == 2);
                          }),
                 0, 0),
    DiskDefect::NonManifoldPoints, 1, 14, "point 14");
}

TEST(DiskMesh, FewPointsOnTheBoundary)
{
  expectDefect({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } } },
    DiskDefect::FewBoundaryPoints, 3, -1, "has 3 points on its boundary; it must have at least 4");
  Mesh sphere = makeSphere({ 0, 0, 0 }, 1.0, 6);
  sphere.Triangles.erase(sphere.Triangles.begin());
  expectDefect(sphere, DiskDefect::FewBoundaryPoints, 3, -1, "has 3 points on its boundary");
  // One more triangle off, and it is a disk.
  sphere.Triangles.erase(sphere.Triangles.begin());
  EXPECT_EQ(DiskMesh(sphere.Surface()).Boundary().size(), 4u);
}

// The points of a grid's boundary counterclockwise, as a loop from one of them on.
void expectGridBoundary(const Ids& found, std::int64_t columns, std::int64_t rows, bool turned)
{
  Ids wanted;
  const std::int64_t width = columns + 1;
  for (std::int64_t x = 0; x < columns; ++x)
  {
    wanted.push_back(x);
  }
  for (std::int64_t y = 0; y < rows; ++y)
  {
    wanted.push_back(columns + y * width);
  }
  for (std::int64_t x = columns; x > 0; --x)
  {
    wanted.push_back(x + rows * width);
  }
  for (std::int64_t y = rows; y > 0; --y)
  {
    wanted.push_back(y * width);
  }
  if (turned)
  {
    std::reverse(wanted.begin(), wanted.end());
  }
  ASSERT_EQ(found.size(), wanted.size());
  const auto first = std::find(wanted.begin(), wanted.end(), found[0]);
  ASSERT_NE(first, wanted.end());
  std::rotate(wanted.begin(), first, wanted.end());
  EXPECT_EQ(found, wanted);
}

TEST(DiskMesh, BoundaryAndOrientation)
{
  const Mesh grid = makeGrid(5, 3);
  expectGridBoundary(DiskMesh(grid.Surface()).Boundary(), 5, 3, false);
  expectGridBoundary(DiskMesh(grid.Turned().Surface()).Boundary(), 5, 3, true);
  // Triangles that disagree go by most of the area.
  for (const bool large : { false, true })
  {
    Mesh mesh = grid;
    mesh.Points[23] = { 50, 60, 0 }; // the last square is larger than all others
    for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
    {
      if ((i >= mesh.Triangles.size() - 2) == large)
      {
        std::swap(mesh.Triangles[i][0], mesh.Triangles[i][1]);
      }
    }
    const DiskMesh disk(mesh.Surface());
    expectGridBoundary(disk.Boundary(), 5, 3, large);
    EXPECT_EQ(disk.Edges().Reversed(), 0);
    EXPECT_EQ(disk.Edges().Open(), 16);
    for (std::int64_t i = 0; i < disk.NumberOfTriangles(); ++i)
    {
      // The same points in the same place of the list; sides as the edges know them.
      const auto& given = mesh.Triangles[static_cast<std::size_t>(i)];
      EXPECT_TRUE(std::is_permutation(given.begin(), given.end(), disk.Triangle(i)));
      for (std::int64_t side = 3 * i; side < 3 * i + 3; ++side)
      {
        const std::int64_t other = disk.Edges().Other(side);
        if (other >= 0)
        {
          const std::int64_t* ids = disk.Triangle(0);
          ASSERT_EQ(ids[side], ids[other % 3 == 2 ? other - 2 : other + 1]);
        }
      }
    }
  }
}

TEST(DiskMesh, AreasAndUnits)
{
  // Squares 1, 2, 3 ... wide, and half as high.
  const Mesh mesh = makeGrid(4, 2).Mapped([](const Point<3>& p) {
    return Point<3>{ 0.5 * p[0] * (p[0] + 1.0) - 3.0, 7.0, 0.5 * p[1] };
  });
  const DiskMesh disk(mesh.Surface());
  EXPECT_EQ(disk.NumberOfPoints(), 15);
  EXPECT_EQ(disk.NumberOfTriangles(), 16);
  EXPECT_DOUBLE_EQ(disk.Unit(), 10.0);
  EXPECT_NEAR(disk.Area(), 0.1, 1e-15);
  double sum = 0.0;
  for (std::int64_t i = 0; i < 16; ++i)
  {
    EXPECT_NEAR(disk.AreaShare(i), 0.25 * static_cast<double>(i / 2 % 4 + 1) / 10.0, 1e-15);
    EXPECT_EQ(disk.AreaShares()[i], disk.AreaShare(i));
    sum += disk.AreaShare(i);
  }
  EXPECT_NEAR(sum, 1.0, 1e-14);
  const TriangleSurface surface = disk.Surface();
  EXPECT_EQ(surface.NumberOfTriangles, 16);
  for (std::int64_t i = 0; i < 15; ++i)
  {
    const Point<3>& given = mesh.Points[static_cast<std::size_t>(i)];
    EXPECT_NEAR(surface.Points[i][0], (given[0] - 2.0) / 10.0, 1e-15);
    EXPECT_NEAR(surface.Points[i][1], 0.0, 1e-15);
    EXPECT_NEAR(surface.Points[i][2], (given[2] - 0.5) / 10.0, 1e-15);
  }
}

// Areas of 1e-400 and 1e400, which no double is.
TEST(DiskMesh, AnyScale)
{
  const Mesh mesh = makeGrid(4, 3).Mapped([](const Point<3>& p) {
    return Point<3>{ p[0] * p[0], p[1] + p[0], std::sin(p[0] * p[1]) };
  });
  const DiskMesh plain(mesh.Surface());
  for (const double scale : { std::ldexp(1.0, -700), std::ldexp(1.0, 700) })
  {
    const Mesh scaled = mesh.Mapped([scale](const Point<3>& p) {
      return Point<3>{ scale * p[0], scale * p[1], scale * p[2] };
    });
    const DiskMesh disk(scaled.Surface());
    EXPECT_EQ(disk.Boundary(), plain.Boundary());
    EXPECT_EQ(disk.Unit(), scale * plain.Unit());
    EXPECT_EQ(disk.Area(), plain.Area());
    for (std::int64_t i = 0; i < plain.NumberOfTriangles(); ++i)
    {
      ASSERT_EQ(disk.AreaShare(i), plain.AreaShare(i));
    }
  }
}

TEST(DiskMesh, SmallestDisks)
{
  const Mesh two{ { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 1 } },
    { { 0, 1, 2 }, { 0, 2, 3 } } };
  DiskMesh disk(two.Surface());
  EXPECT_EQ(disk.Boundary().size(), 4u);
  const Ids loop = disk.Boundary();
  DiskMesh moved = std::move(disk);
  EXPECT_EQ(moved.Boundary(), loop);
  EXPECT_EQ(moved.Edges().Open(), 4);
  disk = std::move(moved);
  EXPECT_EQ(disk.NumberOfTriangles(), 2);
  // A cone: all triangles about one point inside.
  Mesh cone{ { { 0, 0, 1 } }, {} };
  for (std::int64_t i = 0; i < 1000; ++i)
  {
    const double angle = 2.0 * pi * static_cast<double>(i) / 1000.0;
    cone.Points.push_back({ std::cos(angle), std::sin(angle), 0.0 });
    cone.Triangles.push_back({ 0, i + 1, (i + 1) % 1000 + 1 });
  }
  const DiskMesh round(cone.Surface());
  ASSERT_EQ(round.Boundary().size(), 1000u);
  EXPECT_EQ(std::count(round.Boundary().begin(), round.Boundary().end(), 0), 0);
  EXPECT_NEAR(round.AreaShare(77), 1e-3, 1e-12);
}

TEST(DiskMesh, Refused)
{
  Mesh mesh = makeGrid(2, 2);
  mesh.Triangles[3][1] = 9;
  EXPECT_EQ(refusal([&]() { DiskMesh disk(mesh.Surface()); }),
    "triangle 3 has the point 9, but there are 9 points");
  mesh.Triangles[3][1] = -1;
  EXPECT_EQ(refusal([&]() { DiskMesh disk(mesh.Surface()); }),
    "triangle 3 has the point -1, but there are 9 points");
}

TEST(DiskMesh, TooLarge)
{
  const Mesh mesh = makeGrid(2, 2);
  TriangleSurface surface = mesh.Surface();
  surface.NumberOfTriangles = std::int64_t{ 1 } << 60;
  EXPECT_THROW(DiskMesh disk(surface), std::bad_alloc);
  surface = mesh.Surface();
  surface.Points = { mesh.Points[0].data(), std::int64_t{ 1 } << 60 };
  EXPECT_THROW(DiskMesh disk(surface), std::bad_alloc);
}

TEST(DiskMesh, Cancelled)
{
  Mesh mesh = makeGrid(300, 300);
  std::swap(mesh.Triangles[500][0], mesh.Triangles[500][1]); // edges are found twice
  const SerialExecutor executor;
  double reached = -1.0;
  double limit = 2.0;
  const Context context(
    executor,
    [&](double done) {
      EXPECT_GE(done, reached);
      reached = done;
    },
    [&]() { return reached >= limit; });
  const DiskMesh whole(mesh.Surface(), context);
  EXPECT_EQ(reached, 1.0);
  for (const double from : { -1.0, 0.05, 0.3, 0.7, 0.9 })
  {
    reached = -1.0;
    limit = from;
    EXPECT_THROW(DiskMesh(mesh.Surface(), context), Cancelled) << from;
  }
}

} // namespace
} // namespace RectifiedTransport
