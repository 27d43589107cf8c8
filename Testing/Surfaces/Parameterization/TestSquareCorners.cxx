// SPDX-License-Identifier: BSD-3-Clause
// The boundary points that become the corners of the square, and what has no area for their sake.
#include "DiskSurfaces.h"
#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <set>

namespace RectifiedTransport
{
namespace
{

using Corners = std::vector<std::int64_t>;

// From the corner with the smallest number on.
Corners fromTheLeast(Corners corners)
{
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

Corners fromTheLeast(const SquareCorners& corners)
{
  return fromTheLeast(Corners(corners.begin(), corners.end()));
}

std::set<std::int64_t> setOf(const SquareCorners& corners)
{
  return { corners.begin(), corners.end() };
}

TEST(SquareCorners, SharpCornersOfARectangle)
{
  const Mesh sheet = makeRectangle(12, 5, 3.0, 1.0);
  const Corners own = sheetCorners(12, 5);
  EXPECT_EQ(fromTheLeast(chooseCorners(DiskMesh(sheet.Surface()))), own);
  EXPECT_EQ(fromTheLeast(chooseCorners(DiskMesh(turned(sheet).Surface()))), own);
  // Turned over, the boundary goes the other way.
  const Corners reversed{ own[0], own[3], own[2], own[1] };
  EXPECT_EQ(fromTheLeast(chooseCorners(DiskMesh(sheet.Turned().Surface()))), reversed);
  for (std::uint64_t seed = 1; seed < 10; ++seed)
  {
    const RenumberedMesh other = renumber(sheet, seed);
    Corners expected;
    for (const std::int64_t corner : own)
    {
      expected.push_back(other.NumberOf[static_cast<std::size_t>(corner)]);
    }
    EXPECT_EQ(
      fromTheLeast(chooseCorners(DiskMesh(other.Surface.Surface()))), fromTheLeast(expected));
  }
}

// Five sharp corners are not four: then quarters of the length decide.
TEST(SquareCorners, FiveSharpCorners)
{
  // A regular pentagon, whose angles are 108 degrees, with 20 points a side.
  const Mesh pentagon = makeRound(20, [](double radius, double angle) {
    const double part = std::fmod(angle, 0.4 * pi) - 0.2 * pi;
    const double length = radius * std::cos(0.2 * pi) / std::cos(part);
    return Point<3>{ length * std::cos(angle), length * std::sin(angle), 0.0 };
  });
  const DiskMesh disk(pentagon.Surface());
  const std::vector<std::int64_t>& loop = disk.Boundary();
  const SquareCorners corners = chooseCorners(disk);
  for (std::size_t q = 0; q < 4; ++q)
  {
    const auto place = [&](std::size_t corner) {
      return std::find(loop.begin(), loop.end(), corners[corner % 4]) - loop.begin();
    };
    const auto steps = (place(q + 1) - place(q) + 120) % 120;
    EXPECT_GE(steps, 28) << q;
    EXPECT_LE(steps, 32) << q;
  }
}

// The four sides are as long as each other but for one edge of the boundary, however uneven these
// are.
TEST(SquareCorners, QuartersOfTheLength)
{
  for (const double uneven : { 0.0, 0.6 })
  {
    const Mesh round = makeRound(30, [uneven](double radius, double angle) {
      const double moved = angle + uneven * std::sin(angle);
      return Point<3>{ radius * std::cos(moved), radius * std::sin(moved), 0.0 };
    });
    const DiskMesh disk(turned(round).Surface());
    const std::vector<std::int64_t>& loop = disk.Boundary();
    std::vector<double> lengths(loop.size() + 1, 0.0);
    double longest = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const Point<3>& a = round.Points[static_cast<std::size_t>(loop[i])];
      const Point<3>& b = round.Points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
      const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
      longest = std::max(longest, length);
      lengths[i + 1] = lengths[i] + length;
    }
    const SquareCorners corners = chooseCorners(disk);
    for (std::size_t q = 0; q < 4; ++q)
    {
      const auto lengthAt = [&](std::size_t corner) {
        return lengths[static_cast<std::size_t>(
          std::find(loop.begin(), loop.end(), corners[corner % 4]) - loop.begin())];
      };
      const double side = std::fmod(lengthAt(q + 1) - lengthAt(q) + lengths.back(), lengths.back());
      EXPECT_NEAR(side, 0.25 * lengths.back(), longest) << uneven;
    }
    EXPECT_EQ(countCollapsed(disk, corners), 0);
  }
}

// A disk with triangles at some edges of its boundary that have a point of their own each, after
// the disk's. Their height is that part of the edge.
Mesh diskWithEars(
  std::int64_t rings, const std::vector<std::int64_t>& edges, const std::vector<double>& heights)
{
  Mesh mesh = makeRoundDisk(rings);
  const std::int64_t first = 1 + 3 * rings * (rings - 1);
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const std::int64_t a = first + edges[i];
    const std::int64_t b = first + (edges[i] + 1) % (6 * rings);
    const Point<3> from = mesh.Points[static_cast<std::size_t>(a)];
    const Point<3> to = mesh.Points[static_cast<std::size_t>(b)];
    mesh.Triangles.push_back({ b, a, static_cast<std::int64_t>(mesh.Points.size()) });
    mesh.Points.push_back({ 0.5 * (from[0] + to[0]) + heights[i] * (to[1] - from[1]),
      0.5 * (from[1] + to[1]) - heights[i] * (to[0] - from[0]), 0.0 });
  }
  return mesh;
}

// Four edges cut off a triangle each: their points become the corners wherever they are. Of more,
// those with the longest parts of the boundary do, and the others collapse.
TEST(SquareCorners, Ears)
{
  constexpr std::int64_t rings = 8;
  std::mt19937_64 random(4);
  std::vector<std::int64_t> edges(6 * rings);
  std::iota(edges.begin(), edges.end(), 0);
  for (int run = 0; run < 100; ++run)
  {
    std::shuffle(edges.begin(), edges.end(), random);
    const std::size_t ears = 1 + random() % 9;
    std::vector<double> heights(ears);
    for (std::size_t i = 0; i < ears; ++i)
    {
      heights[i] = 0.3 + 0.1 * static_cast<double>(ears - i);
    }
    const Mesh mesh = diskWithEars(
      rings, { edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(ears) }, heights);
    const DiskMesh disk(mesh.Surface());
    const SquareCorners corners = chooseCorners(disk);
    const std::set<std::int64_t> chosen = setOf(corners);
    ASSERT_EQ(chosen.size(), 4u);
    for (std::size_t i = 0; i < std::min<std::size_t>(ears, 4); ++i)
    {
      EXPECT_EQ(chosen.count(static_cast<std::int64_t>(mesh.Points.size() - ears + i)), 1u)
        << i << " of " << ears;
    }
    EXPECT_EQ(countCollapsed(disk, corners),
      std::max<std::int64_t>(static_cast<std::int64_t>(ears) - 4, 0));
  }
}

// A convex polygon cut into triangles at random: no points inside, all edges cut it.
Mesh makePolygon(std::int64_t points, std::mt19937_64& random)
{
  Mesh mesh;
  std::vector<std::int64_t> loop;
  for (std::int64_t i = 0; i < points; ++i)
  {
    const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(points);
    mesh.Points.push_back({ std::cos(angle), 2.0 * std::sin(angle), 0.0 });
    loop.push_back(i);
  }
  while (loop.size() >= 3)
  {
    const std::size_t cut = random() % loop.size();
    const std::size_t before = (cut + loop.size() - 1) % loop.size();
    mesh.Triangles.push_back({ loop[before], loop[cut], loop[(cut + 1) % loop.size()] });
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(cut));
  }
  return mesh;
}

// By the positions that the corners give the points of the boundary.
std::int64_t countCollapsedInSquare(const DiskMesh& disk, const SquareCorners& corners)
{
  const SquareMap map = mapConformally(disk, corners).Square;
  std::int64_t collapsed = 0;
  for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
  {
    bool isLevel = false;
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      for (const double level : { 0.0, 1.0 })
      {
        isLevel =
          isLevel || std::all_of(disk.Triangle(t), disk.Triangle(t) + 3, [&](std::int64_t id) {
            return map.Positions[static_cast<std::size_t>(id)][axis] == level;
          });
      }
    }
    collapsed += isLevel ? 1 : 0;
  }
  return collapsed;
}

TEST(SquareCorners, CutPolygons)
{
  std::mt19937_64 random(6);
  int few = 0;
  int many = 0;
  for (int run = 0; run < 200; ++run)
  {
    const std::int64_t points = 4 + static_cast<std::int64_t>(random() % 20);
    const DiskMesh disk(makePolygon(points, random).Surface());
    std::int64_t ears = 0;
    for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
    {
      int open = 0;
      for (std::int64_t side = 3 * t; side < 3 * t + 3; ++side)
      {
        open += disk.Edges().Other(side) < 0 ? 1 : 0;
      }
      ears += open == 2 ? 1 : 0;
    }
    const SquareCorners corners = chooseCorners(disk);
    ASSERT_EQ(setOf(corners).size(), 4u);
    const std::int64_t collapsed = countCollapsed(disk, corners);
    EXPECT_EQ(collapsed, countCollapsedInSquare(disk, corners));
    if (ears <= 4)
    {
      EXPECT_EQ(collapsed, 0) << points << " points, " << ears << " ears";
      ++few;
    }
    else
    {
      EXPECT_GE(collapsed, ears - 4);
      ++many;
    }
  }
  EXPECT_GT(few, 50);
  EXPECT_GT(many, 50);
}

TEST(SquareCorners, CollapsedOfAStrip)
{
  const DiskMesh disk(makeRectangle(10, 1, 10.0, 1.0).Surface());
  EXPECT_EQ(fromTheLeast(chooseCorners(disk)), sheetCorners(10, 1));
  EXPECT_EQ(countCollapsed(disk, chooseCorners(disk)), 0);
  // All corners on the lower side: one of each quad's triangles but the first three quads' keeps an
  // area, and of these the one at the left border loses it.
  EXPECT_EQ(countCollapsed(disk, { 0, 1, 2, 3 }), 1 + 2 * 7);
  EXPECT_EQ(countCollapsedInSquare(disk, { 0, 1, 2, 3 }), 1 + 2 * 7);
}

TEST(SquareCorners, FourPoints)
{
  const Mesh quad{ { { 0, 0, 0 }, { 1, 0, 0 }, { 3, 3, 0 }, { 0, 1, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 } } };
  const DiskMesh disk(quad.Surface());
  EXPECT_EQ(fromTheLeast(chooseCorners(disk)), (Corners{ 0, 1, 2, 3 }));
  EXPECT_EQ(countCollapsed(disk, chooseCorners(disk)), 0);
}

TEST(SquareCorners, Ordered)
{
  const DiskMesh disk(makeRectangle(4, 3).Surface());
  Corners points = sheetCorners(4, 3);
  const Corners around = points;
  std::sort(points.begin(), points.end());
  do
  {
    const auto first = std::find(around.begin(), around.end(), points[0]) - around.begin();
    const SquareCorners ordered = orderCorners(disk, points);
    for (std::size_t q = 0; q < 4; ++q)
    {
      EXPECT_EQ(ordered[q], around[(static_cast<std::size_t>(first) + q) % 4]);
    }
  } while (std::next_permutation(points.begin(), points.end()));
}

TEST(SquareCorners, TurnedAlongTheBoundary)
{
  const DiskMesh disk(makeRoundDisk(8).Surface());
  const std::vector<std::int64_t>& loop = disk.Boundary();
  ASSERT_EQ(loop.size(), 48u);
  const SquareCorners corners = chooseCorners(disk);
  const SquareCorners turned = turnCorners(disk, corners, 1.0 / 8.0);
  std::set<std::int64_t> wanted;
  for (const std::int64_t corner : corners)
  {
    const auto place = std::find(loop.begin(), loop.end(), corner) - loop.begin();
    wanted.insert(loop[(static_cast<std::size_t>(place) + 6) % 48]);
  }
  EXPECT_EQ(setOf(turned), wanted);
  EXPECT_EQ(setOf(turnCorners(disk, corners, 0.25)), setOf(corners));
  // There are no others.
  const DiskMesh square(makeRectangle(1, 1).Surface());
  const SquareCorners only = chooseCorners(square);
  EXPECT_EQ(setOf(turnCorners(square, only, 1.0 / 8.0)), setOf(only));
}

TEST(SquareCorners, Refused)
{
  const DiskMesh disk(makeRectangle(4, 3).Surface());
  const auto refused = [&disk](const Corners& points) {
    return refusal([&]() { orderCorners(disk, points); });
  };
  EXPECT_EQ(refused({}), "are 0 points; they must be 4 of the boundary, or none");
  EXPECT_EQ(refused({ 0, 1, 2, 3, 4 }), "are 5 points; they must be 4 of the boundary, or none");
  EXPECT_EQ(refused({ 0, 1, 20, 2 }), "have the point 20; there are points 0 to 19");
  EXPECT_EQ(refused({ -1, 1, 2, 3 }), "have the point -1; there are points 0 to 19");
  EXPECT_EQ(refused({ 0, 4, 6, 15 }),
    "have the point 6, which is not on the boundary of the surface; they must be 4 points of it");
  EXPECT_EQ(refused({ 0, 4, 19, 4 }), "have the point 4 twice; they must be 4 different points");
}

} // namespace
} // namespace RectifiedTransport
