// SPDX-License-Identifier: BSD-3-Clause
// From any triangles to a closed surface of one orientation: what is merged, counted, refused and
// turned, at once and in steps, until the solid is covered.
#include "ClosedMeshes.h"
#include "HangingNodes.h"
#include "SolidSurfaces.h"
#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace RectifiedTransport
{
namespace
{

// Points of its own for each triangle, as in a file of separate faces.
Mesh separate(const Mesh& mesh)
{
  Mesh apart;
  for (const auto& triangle : mesh.Triangles)
  {
    const auto first = static_cast<std::int64_t>(apart.Points.size());
    for (const std::int64_t id : triangle)
    {
      apart.Points.push_back(mesh.Points[static_cast<std::size_t>(id)]);
    }
    apart.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return apart;
}

Mesh turnSome(Mesh mesh)
{
  std::mt19937_64 random(4);
  for (auto& triangle : mesh.Triangles)
  {
    if (random() % 4 == 0)
    {
      std::swap(triangle[1], triangle[2]);
    }
  }
  return mesh;
}

Mesh copyOf(const TriangleSurface& surface)
{
  Mesh mesh;
  for (std::int64_t i = 0; i < surface.Points.size(); ++i)
  {
    mesh.Points.push_back({ surface.Points[i][0], surface.Points[i][1], surface.Points[i][2] });
  }
  for (std::int64_t i = 0; i < surface.NumberOfTriangles; ++i)
  {
    const std::int64_t* ids = surface.Triangles + 3 * i;
    mesh.Triangles.push_back({ ids[0], ids[1], ids[2] });
  }
  return mesh;
}

TEST(ClosedMesh, SeparateFacesBecomeASolid)
{
  const Mesh sphere = makeSphere({ 8.1, 7.9, 8.2 }, 6.0, 20);
  const Mesh soup = turnSome(separate(sphere));
  ClosedMesh mesh = closedMesh(soup.Surface());
  EXPECT_TRUE(mesh.IsClosed());
  EXPECT_EQ(mesh.OpenEdges() + mesh.NonManifoldEdges(), 0);
  EXPECT_TRUE(mesh.Orient());
  EXPECT_TRUE(mesh.Orient()); // of no effect
  const Mesh closed = copyOf(mesh.Surface());
  ASSERT_EQ(closed.Triangles.size(), sphere.Triangles.size());
  EXPECT_NEAR(closed.Volume(), sphere.Volume(), 1e-10);
  std::int64_t open = -1;
  const auto coverage = cover(closed, { 16, 16, 16 }, 2, SerialExecutor(), &open);
  EXPECT_EQ(open, 0);
  EXPECT_NEAR(sum(coverage), sphere.Volume(), 0.02 * sphere.Volume());
}

// Corners at one point, as where quads end at a pole: their triangles are no longer there.
TEST(ClosedMesh, TrianglesOfFewerPointsAreDropped)
{
  Mesh box = makeBox({ 0, 0, 0 }, { 2, 3, 4 });
  const std::size_t whole = box.Triangles.size();
  box.Points.push_back(box.Points[3]);
  box.Triangles.push_back({ 3, 8, 5 });
  box.Triangles.push_back({ 1, 1, 6 });
  ClosedMesh mesh = closedMesh(box.Surface());
  EXPECT_TRUE(mesh.IsClosed());
  EXPECT_EQ(static_cast<std::size_t>(mesh.Surface().NumberOfTriangles), whole);
}

TEST(ClosedMesh, CountsOfWhatIsNotClosed)
{
  Mesh box = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  box.Triangles.pop_back();
  ClosedMesh open = closedMesh(box.Surface());
  EXPECT_FALSE(open.IsClosed());
  EXPECT_EQ(open.OpenEdges(), 3);
  EXPECT_EQ(open.NonManifoldEdges(), 0);
  EXPECT_FALSE(open.Orient());
  // A fin on an edge, whose other sides are open.
  box = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  box.Points.push_back({ 2, 2, 2 });
  box.Triangles.push_back({ 0, 1, 8 });
  ClosedMesh fin = closedMesh(separate(box).Surface());
  EXPECT_FALSE(fin.IsClosed());
  EXPECT_EQ(fin.OpenEdges(), 2);
  EXPECT_EQ(fin.NonManifoldEdges(), 1);
  EXPECT_FALSE(fin.Orient());
  // Points that differ by more than rounding are two.
  box = separate(makeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  box.Points[7][0] = std::nextafter(box.Points[7][0], 2.0);
  EXPECT_TRUE(closedMesh(box.Surface()).IsClosed());
  box.Points[7][0] += 1e-8;
  EXPECT_EQ(closedMesh(box.Surface()).OpenEdges(), 4);
}

// Sides of one face are half as long as those of its neighbours.
TEST(ClosedMesh, TJunctionsAreClosed)
{
  for (const std::int64_t ratio : { 1, 2, 5 })
  {
    Mesh box = makeRefinedBox(3, ratio);
    ClosedMesh mesh = closedMesh(box.Surface());
    EXPECT_TRUE(mesh.IsClosed());
    EXPECT_EQ(mesh.TJunctions(), 12 * (ratio - 1));
    EXPECT_TRUE(mesh.Orient());
    EXPECT_NEAR(std::abs(copyOf(mesh.Surface()).Volume()), 1.0, 1e-12);
    // With a hole it stays open; the counts are those of the given triangles.
    box.Triangles.erase(box.Triangles.end() - 2 * 3 * ratio);
    ClosedMesh open = closedMesh(box.Surface());
    EXPECT_FALSE(open.IsClosed());
    EXPECT_EQ(open.TJunctions(), 0);
    EXPECT_EQ(open.OpenEdges(), 3 + (ratio == 1 ? 0 : 12 * (1 + ratio)));
  }
}

// The longer sides bend to points that are off them, but not farther than the distance.
TEST(ClosedMesh, GapingTJunctions)
{
  constexpr double gap = 3e-3;
  const Mesh box = makeRefinedBox(3, 2).Mapped([](const Point<3>& x) {
    const bool isFine = x[1] == 0.0 && std::abs(6.0 * x[0] - 3.0) < 0.1;
    return isFine && x[2] == 1.0 ? Point<3>{ x[0], x[1] - gap, x[2] } : x;
  });
  ClosedMesh mesh = closedMesh(box.Surface());
  EXPECT_FALSE(mesh.IsClosed());
  EXPECT_FALSE(mesh.CloseTJunctions(0.9 * gap));
  EXPECT_EQ(mesh.WidestGap(), 0.0);
  ASSERT_TRUE(mesh.CloseTJunctions(1.1 * gap));
  EXPECT_EQ(mesh.TJunctions(), 12);
  EXPECT_NEAR(mesh.WidestGap(), gap, 1e-15);
  EXPECT_TRUE(mesh.Orient());
  // A bump over two triangles of each face: a third of a height times an area.
  EXPECT_GT(std::abs(copyOf(mesh.Surface()).Volume()), 1.0);
  EXPECT_LT(std::abs(copyOf(mesh.Surface()).Volume()), 1.0 + gap);
}

TEST(ClosedMesh, NothingIsClosed)
{
  ClosedMesh mesh = closedMesh(Mesh{}.Surface());
  EXPECT_TRUE(mesh.IsClosed());
  EXPECT_TRUE(mesh.Orient());
  EXPECT_EQ(mesh.Surface().NumberOfTriangles, 0);
}

TEST(ClosedMesh, OneSideOnly)
{
  const std::int64_t around = 12;
  const std::int64_t across = 10;
  Mesh klein = makeTorus(around, across, [](double u, double v) {
    return Point<3>{ u, v, u * v + u };
  });
  EXPECT_TRUE(closedMesh(klein.Surface()).Orient());
  // The last ring meets the first one mirrored.
  for (auto& triangle : klein.Triangles)
  {
    const bool last = *std::max_element(triangle.begin(), triangle.end()) >= (around - 1) * across;
    for (std::int64_t& id : triangle)
    {
      id = last && id < across ? (across - id) % across : id;
    }
  }
  ClosedMesh mesh = closedMesh(klein.Surface());
  EXPECT_TRUE(mesh.IsClosed());
  EXPECT_FALSE(mesh.Orient());
}

// A cavity keeps the orientation of most of its area.
TEST(ClosedMesh, ComponentsAreOrientedAlone)
{
  Mesh shell = makeSphere({ 0, 0, 0 }, 2.0, 12);
  shell.Add(makeSphere({ 0, 0, 0 }, 1.0, 9).Turned());
  ClosedMesh mesh = closedMesh(turnSome(shell).Surface());
  EXPECT_TRUE(mesh.Orient());
  EXPECT_EQ(copyOf(mesh.Surface()).Triangles, shell.Triangles);
}

TEST(ClosedMesh, InSteps)
{
  const Mesh soup = turnSome(separate(makeSphere({ 1, 2, 3 }, 1.0, 9)));
  LargeBuffer<double> coordinates(static_cast<std::int64_t>(3 * soup.Points.size()));
  std::copy_n(soup.Points.data()->data(), coordinates.size(), coordinates.data());
  ClosedMesh mesh(std::move(coordinates));
  for (std::size_t i = 0; i < soup.Points.size(); ++i)
  {
    const std::int64_t first = mesh.FirstOf(static_cast<std::int64_t>(i));
    ASSERT_LE(first, static_cast<std::int64_t>(i));
    ASSERT_EQ(soup.Points[static_cast<std::size_t>(first)], soup.Points[i]);
    ASSERT_EQ(mesh.FirstOf(first), first);
  }
  mesh.Reserve(static_cast<std::int64_t>(soup.Triangles.size()));
  for (const auto& triangle : soup.Triangles)
  {
    mesh.Add(triangle);
  }
  EXPECT_FALSE(mesh.IsClosed()) << "not counted yet";
  mesh.CountEdges(SerialExecutor());
  ASSERT_TRUE(mesh.IsClosed());
  // Moved points stay merged.
  const PointSpan<3> points = mesh.Points();
  std::transform(points.data(), points.data() + 3 * points.size(), points.data(),
    [](double x) { return 2.0 * x; });
  ClosedMesh moved = std::move(mesh);
  EXPECT_TRUE(moved.Orient(SerialExecutor()));
  ClosedMesh atOnce = closedMesh(
    soup.Mapped([](const Point<3>& p) {
          return Point<3>{ 2.0 * p[0], 2.0 * p[1], 2.0 * p[2] };
        })
      .Surface());
  EXPECT_TRUE(atOnce.Orient());
  EXPECT_EQ(copyOf(moved.Surface()).Points, copyOf(atOnce.Surface()).Points);
  EXPECT_EQ(copyOf(moved.Surface()).Triangles, copyOf(atOnce.Surface()).Triangles);
}

TEST(ClosedMesh, Refused)
{
  Mesh box = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  box.Triangles[5][1] = 8;
  EXPECT_EQ(refusal([&]() { closedMesh(box.Surface()); }),
    "triangle 5 has the point 8, but there are 8 points");
  box.Triangles[5][1] = -1;
  EXPECT_EQ(refusal([&]() { closedMesh(box.Surface()); }),
    "triangle 5 has the point -1, but there are 8 points");
}

TEST(ClosedMesh, ProgressAndCancel)
{
  const Mesh soup = turnSome(separate(makeSphere({ 0, 0, 0 }, 1.0, 150)));
  std::vector<double> heard;
  double limit = 2.0;
  const OpenMPExecutor threads;
  const Context context(
    threads, [&heard](double done) { heard.push_back(done); },
    [&]() { return !heard.empty() && heard.back() >= limit; });
  ClosedMesh mesh = closedMesh(soup.Surface(), context);
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  EXPECT_EQ(heard.back(), 1.0);
  for (const double from : { 0.0, 0.2, 0.45, 0.8 })
  {
    heard.clear();
    limit = from;
    EXPECT_THROW(closedMesh(soup.Surface(), context), Cancelled) << from;
  }
  heard.clear();
  limit = 0.5;
  EXPECT_THROW(mesh.Orient(context), Cancelled);
}

LargeBuffer<double> coordinatesOf(const Mesh& mesh)
{
  LargeBuffer<double> coordinates(static_cast<std::int64_t>(3 * mesh.Points.size()));
  std::copy_n(mesh.Points[0].data(), coordinates.size(), coordinates.data());
  return coordinates;
}

// A mesh within the unit cube. Returns what is wrong.
std::string close(const Mesh& given, bool areFloats, bool& hadGaps)
{
  ClosedMesh mesh(coordinatesOf(given));
  const auto add = [&given](ClosedMesh& made, Progress&) {
    made.Reserve(static_cast<std::int64_t>(given.Triangles.size()));
    for (const auto& triangle : given.Triangles)
    {
      made.Add(triangle);
    }
  };
  const std::string problem = mesh.Close(add, { { 0, 1, 0, 1, 0, 1 }, areFloats });
  EXPECT_TRUE(!problem.empty() || mesh.IsClosed());
  hadGaps = mesh.HadGaps();
  return problem;
}

// Corners that are off by more than rounding in double are merged if they are floats; T-junctions
// may gape by a hundredth of the longest side.
TEST(ClosedMesh, IsClosedAsLittleAsItTakes)
{
  bool hadGaps = true;
  const Mesh box = separate(makeBox({ 0, 0, 0 }, { 1, 1, 1 }));
  EXPECT_EQ(close(box, false, hadGaps), "");
  EXPECT_FALSE(hadGaps);
  Mesh off = box;
  off.Points[7][0] += 1e-7;
  EXPECT_EQ(close(off, true, hadGaps), "");
  EXPECT_FALSE(hadGaps);
  EXPECT_EQ(close(off, false, hadGaps).substr(0, 62),
    "is not closed: it has 4 open edges and 0 non-manifold edges; e");
  const auto top = [](double gap) {
    return makeRefinedBox(2, 2).Mapped([gap](const Point<3>& x) {
      const bool isOwn = x[2] == 1.0 &&
        (2.0 * x[0] != std::floor(2.0 * x[0]) || 2.0 * x[1] != std::floor(2.0 * x[1]));
      return isOwn ? Point<3>{ x[0], x[1], x[2] + gap } : x;
    });
  };
  EXPECT_EQ(close(top(0.0), false, hadGaps), "");
  EXPECT_FALSE(hadGaps);
  EXPECT_EQ(close(top(9e-3), false, hadGaps), "");
  EXPECT_TRUE(hadGaps);
  EXPECT_NE(close(top(0.02), false, hadGaps), "");
}

TEST(ClosedMesh, SaysWhatHasNoInside)
{
  bool hadGaps = false;
  Mesh twice = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  twice.Add(twice.Turned());
  EXPECT_EQ(close(twice, false, hadGaps),
    "has each polygon twice, in opposite directions, so that nothing is inside; keep one of each");
  const Mesh line{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 0 } }, { { 0, 1, 2 } } };
  EXPECT_EQ(close(line, false, hadGaps),
    "has 3 points and no polygon of three different ones; a solid needs a closed surface");
}

} // namespace
} // namespace RectifiedTransport
