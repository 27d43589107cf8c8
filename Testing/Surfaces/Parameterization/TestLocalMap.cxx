// SPDX-License-Identifier: BSD-3-Clause
// A part of a map: which coordinates may change, and how areas do.
#include "DiskSurfaces.h"
#include "Surfaces/Parameterization/LocalMap.h"

#include <gtest/gtest.h>

#include <set>

namespace RectifiedTransport
{
namespace
{

using Positions = std::vector<Point<2>>;

TEST(LocalMap, TrianglesOfPoints)
{
  const RenumberedMesh mesh = renumber(makeRoundDisk(5));
  const DiskMesh disk(mesh.Surface.Surface());
  const PointTriangles triangles(disk);
  std::int64_t count = 0;
  for (std::int64_t point = 0; point < disk.NumberOfPoints(); ++point)
  {
    const auto about = triangles[point];
    std::set<std::int64_t> found(about.begin(), about.end());
    count += static_cast<std::int64_t>(found.size());
    for (const std::int64_t t : found)
    {
      EXPECT_NE(std::find(disk.Triangle(t), disk.Triangle(t) + 3, point), disk.Triangle(t) + 3);
    }
  }
  EXPECT_EQ(count, 3 * disk.NumberOfTriangles());
}

// Two coordinates inside, one on a side, none at a corner.
TEST(LocalMap, Unknowns)
{
  const SquareGrid grid(5); // 6 points a side
  const auto unknownsOf = [&grid](const std::vector<std::int64_t>& points) {
    return LocalMap(grid.Parts, points, grid.Square.Positions).NumberOfUnknowns();
  };
  EXPECT_EQ(unknownsOf({ 7 }), 2);
  EXPECT_EQ(unknownsOf({ 1 }), 1);
  EXPECT_EQ(unknownsOf({ 6 }), 1);
  EXPECT_EQ(unknownsOf({ 0 }), 0);
  EXPECT_EQ(unknownsOf({ 0, 1, 2, 7, 8, 35 }), 6);
  const LocalMap map(grid.Parts, { 7 }, grid.Square.Positions);
  EXPECT_EQ(map.NumberOfTriangles(), 6u);
}

// Areas are linear in each coordinate: differences are derivatives.
TEST(LocalMap, Gradients)
{
  const SquareGrid grid(4);
  std::vector<std::int64_t> all(25);
  std::iota(all.begin(), all.end(), 0);
  Positions positions = grid.Square.Positions;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (const std::int64_t point : { 6, 7, 8, 11, 12, 13, 16, 17, 18 })
  {
    for (double& x : positions[static_cast<std::size_t>(point)])
    {
      x += 0.1 * number(random);
    }
  }
  const LocalMap map(grid.Parts, all, positions);
  for (std::size_t t = 0; t < map.NumberOfTriangles(); ++t)
  {
    EXPECT_NEAR(
      map.AreaOf(t, map.Positions()), 0.5 * turnOf(grid.Disk, map.IdOf(t), positions), 1e-16);
    const TriangleVector gradient = map.AreaGradient(t);
    for (std::size_t i = 0; i < 6; ++i)
    {
      Positions moved = map.Positions();
      moved[static_cast<std::size_t>(map.CornersOf(t)[i / 2])][i % 2] += 1.0;
      EXPECT_NEAR(map.AreaOf(t, moved) - map.AreaOf(t, map.Positions()), gradient[i], 1e-14);
    }
  }
}

TEST(LocalMap, MovesAndStores)
{
  const SquareGrid grid(5);
  LocalMap map(grid.Parts, { 0, 1, 7, 11 }, grid.Square.Positions);
  ASSERT_EQ(map.NumberOfUnknowns(), 4); // x of 1, x and y of 7, y of 11
  const std::vector<double> solution{ 0.2, -0.1, 4.0, 0.4 };
  Positions stored = grid.Square.Positions;
  EXPECT_EQ(map.Descend(solution, 1.0, 2, [](const Positions&) { return 1.0; }), 0.0);
  map.Store(stored);
  EXPECT_EQ(stored, grid.Square.Positions);
  // Only half the step has less energy than before.
  const std::vector<double> energies{ 1.0, 2.0, 0.0 };
  std::size_t next = 0;
  EXPECT_EQ(map.Descend(solution, 1.0, 2, [&](const Positions&) { return energies[next++]; }), 0.5);
  map.Store(stored);
  Positions expected = grid.Square.Positions;
  expected[1][0] += 0.1;
  expected[7][0] -= 0.05;
  expected[7][1] = 1.0; // kept in the square
  expected[11][1] += 0.2;
  EXPECT_EQ(stored, expected);
}

// On one side, wherever the points are there; not where they are only level with each other.
TEST(LocalMap, Collapsed)
{
  const DiskMesh disk(makeRectangle(10, 1).Surface());
  const SquareCorners corners{ 0, 1, 2, 3 };
  const SquareMap square = mapConformally(disk, corners).Square;
  const MapParts parts(disk, square);
  std::vector<std::int64_t> all(22);
  std::iota(all.begin(), all.end(), 0);
  const LocalMap map(parts, all, square.Positions);
  std::int64_t collapsed = 0;
  for (std::size_t t = 0; t < map.NumberOfTriangles(); ++t)
  {
    collapsed += map.IsCollapsed(t) ? 1 : 0;
    EXPECT_EQ(map.IsCollapsed(t), turnOf(disk, map.IdOf(t), square.Positions) == 0.0);
  }
  EXPECT_EQ(collapsed, countCollapsed(disk, corners));
  EXPECT_GT(collapsed, 10);
}

} // namespace
} // namespace RectifiedTransport
