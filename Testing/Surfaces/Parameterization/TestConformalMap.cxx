// SPDX-License-Identifier: BSD-3-Clause
// Conformal maps to rectangles: of rectangles and annuli, whose maps are known, and what must not
// change a map.
#include "DiskSurfaces.h"
#include "RecordingContext.h"
#include "ThreadsExecutor.h"

#include "Surfaces/Parameterization/MapDistortion.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

const SerialExecutor serial;

using Positions = std::vector<Point<2>>;

TEST(ConformalMap, FlatRectanglesStayAsTheyAre)
{
  for (const double width : { 1.0, 0.2, 3.0, 40.0 })
  {
    for (const bool random : { false, true })
    {
      const Mesh unit = random ? makeRandomTriangulation(20, 15, 1e-4) : makeRectangle(20, 15);
      const Mesh mesh = unit.Mapped([width](const Point<3>& p) {
        return Point<3>{ width * p[0], p[1], p[2] };
      });
      const ConformalMap map = mapped(DiskMesh(turned(mesh).Surface()), sheetCorners(20, 15));
      for (std::size_t i = 0; i < mesh.Points.size(); ++i)
      {
        ASSERT_NEAR(map.Square.Positions[i][0], unit.Points[i][0], 1e-12) << width;
        ASSERT_NEAR(map.Square.Positions[i][1], unit.Points[i][1], 1e-12) << width;
      }
      EXPECT_NEAR(map.AspectRatio, width, 1e-12 * width);
    }
  }
}

// The largest errors of the two coordinates of an annulus' map, and that of the ratio of the sides.
std::array<double, 3> annulusErrors(double radius, std::int64_t cells, std::size_t firstCorner)
{
  const Mesh mesh = makeQuarterAnnulus(radius, cells, 2 * cells);
  std::vector<std::int64_t> corners = sheetCorners(cells, 2 * cells);
  std::rotate(
    corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(firstCorner), corners.end());
  const ConformalMap map = mapped(DiskMesh(mesh.Surface()), corners);
  std::array<double, 3> errors{};
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    const Point<3>& p = mesh.Points[i];
    Point<2> truth{ std::log(std::hypot(p[0], p[1])) / std::log(radius),
      std::atan2(p[1], p[0]) / (0.5 * pi) };
    for (std::size_t quarter = 0; quarter < firstCorner; ++quarter)
    {
      truth = { truth[1], 1.0 - truth[0] };
    }
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      errors[axis] = std::max(errors[axis], std::abs(map.Square.Positions[i][axis] - truth[axis]));
    }
  }
  const double ratio = std::log(radius) / (0.5 * pi);
  errors[2] = std::abs(map.AspectRatio / (firstCorner % 2 == 0 ? ratio : 1.0 / ratio) - 1.0);
  return errors;
}

// The logarithm of the radius and the angle, in the order and direction that the corners give; the
// error is of second order.
TEST(ConformalMap, QuarterAnnulus)
{
  for (const double radius : { 2.0, 5.0 })
  {
    for (std::size_t first = 0; first < 4; ++first)
    {
      const auto coarse = annulusErrors(radius, 10, first);
      const auto fine = annulusErrors(radius, 40, first);
      const auto slope = [](double a, double b) { return std::log2(a / b) / 2.0; };
      const std::size_t along = first % 2; // the radius'
      EXPECT_LT(fine[along], 1e-3);
      EXPECT_GT(slope(coarse[along], fine[along]), 1.8);
      EXPECT_LT(slope(coarse[along], fine[along]), 2.3);
      // Angles are exact, by symmetry.
      EXPECT_LT(fine[1 - along], 1e-3);
      EXPECT_GT(slope(coarse[2], fine[2]), 1.8);
      EXPECT_LT(slope(coarse[2], fine[2]), 2.3);
    }
  }
}

// Angles of a curved surface are kept ever better.
TEST(ConformalMap, KeepsAngles)
{
  double before = 2.0;
  for (const std::int64_t cells : { 12, 24, 48 })
  {
    const DiskMesh disk(makeTerrain(cells, cells).Surface());
    const ConformalMap map = mapped(disk, sheetCorners(cells, cells));
    Positions rectangle = map.Square.Positions;
    for (Point<2>& position : rectangle)
    {
      position[0] *= map.AspectRatio;
    }
    const double excess = measureDistortion(disk, rectangle).AngleMean - 1.0;
    EXPECT_LT(excess, 0.65 * before) << cells;
    before = excess;
  }
  EXPECT_LT(before, 0.05);
}

TEST(ConformalMap, WhateverThePlaceAndTheSize)
{
  const Mesh mesh = makeTerrain(20, 30);
  const std::vector<std::int64_t> corners = sheetCorners(20, 30);
  const ConformalMap map = mapped(DiskMesh(mesh.Surface()), corners);
  const auto expectSame = [&](const Mesh& other, double tolerance) {
    const ConformalMap found = mapped(DiskMesh(other.Surface()), corners);
    EXPECT_LT(largestDifference(map.Square.Positions, found.Square.Positions), tolerance);
    EXPECT_NEAR(found.AspectRatio, map.AspectRatio, tolerance);
  };
  expectSame(turned(mesh), 1e-11);
  for (const double scale : { 1e-200, 1e-3, 7.0, 1e200 })
  {
    expectSame(mesh.Mapped([scale](const Point<3>& p) {
      return Point<3>{ scale * p[0], scale * p[1], scale * p[2] };
    }),
      1e-11);
  }
  expectSame(mesh.Mapped([](const Point<3>& p) {
    return Point<3>{ p[0] + 64.0, p[1] - 32.0, p[2] + 8.0 };
  }),
    1e-10);

  const RenumberedMesh renumbered = renumber(mesh);
  std::vector<std::int64_t> renumberedCorners;
  for (const std::int64_t corner : corners)
  {
    renumberedCorners.push_back(renumbered.NumberOf[static_cast<std::size_t>(corner)]);
  }
  const ConformalMap found = mapped(DiskMesh(renumbered.Surface.Surface()), renumberedCorners);
  EXPECT_LT(
    largestDifference(map.Square.Positions, found.Square.Positions, renumbered.NumberOf), 1e-11);
  // Turned over, the order of the corners is the other one, and the square is seen from below.
  const ConformalMap mirrored = mapped(DiskMesh(mesh.Turned().Surface()), corners);
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    ASSERT_NEAR(mirrored.Square.Positions[i][0], map.Square.Positions[i][1], 1e-11);
    ASSERT_NEAR(mirrored.Square.Positions[i][1], map.Square.Positions[i][0], 1e-11);
  }
}

// Points of the boundary are on their sides to the bit and say so; no other point is or does.
TEST(ConformalMap, Sides)
{
  const Mesh mesh = makeCap(15, 0.5 * pi);
  const DiskMesh disk(mesh.Surface());
  const SquareCorners corners = chooseCorners(disk);
  const SquareMap map = mapConformally(disk, corners).Square;
  EXPECT_EQ(map.Corners, corners);
  std::vector<unsigned char> onSides(mesh.Points.size(), 0);
  const std::vector<std::int64_t>& loop = disk.Boundary();
  const Point<2> truths[4] = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
  for (std::size_t q = 0; q < 4; ++q)
  {
    EXPECT_EQ(map.Positions[static_cast<std::size_t>(corners[q])], truths[q]);
    const std::size_t across = q % 2 == 0 ? 1 : 0; // the coordinate that the side fixes
    const double sign = q < 2 ? 1.0 : -1.0;
    const auto start =
      static_cast<std::size_t>(std::find(loop.begin(), loop.end(), corners[q]) - loop.begin());
    double last = -HUGE_VAL;
    for (std::size_t i = 0;; ++i)
    {
      const std::int64_t id = loop[(start + i) % loop.size()];
      const Point<2>& position = map.Positions[static_cast<std::size_t>(id)];
      EXPECT_EQ(position[across], truths[q][across]);
      EXPECT_GT(sign * position[1 - across], last) << "points of a side keep their order";
      last = sign * position[1 - across];
      onSides[static_cast<std::size_t>(id)] |= static_cast<unsigned char>(1u << across);
      if (id == corners[(q + 1) % 4])
      {
        break;
      }
    }
  }
  EXPECT_EQ(map.OnSides, onSides);
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    if (onSides[i] == 0)
    {
      EXPECT_GT(std::min(map.Positions[i][0], map.Positions[i][1]), 0.0);
      EXPECT_LT(std::max(map.Positions[i][0], map.Positions[i][1]), 1.0);
    }
  }
}

// Without unknowns, and with those of one coordinate only.
TEST(ConformalMap, FewTriangles)
{
  const Mesh pair{ { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 0, 1, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 } } };
  const ConformalMap two = mapped(DiskMesh(pair.Surface()), { 0, 1, 2, 3 });
  EXPECT_EQ(two.Square.Positions, (Positions{ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }));
  EXPECT_EQ(two.Square.OnSides, (std::vector<unsigned char>{ 3, 3, 3, 3 }));
  EXPECT_NEAR(two.AspectRatio, 2.0, 1e-15);

  const Mesh row = makeRectangle(30, 1, 6.0, 1.0);
  const ConformalMap strip = mapped(DiskMesh(row.Surface()), sheetCorners(30, 1));
  for (std::size_t i = 0; i < row.Points.size(); ++i)
  {
    EXPECT_NEAR(strip.Square.Positions[i][0], row.Points[i][0] / 6.0, 1e-13);
    EXPECT_EQ(strip.Square.Positions[i][1], row.Points[i][1]);
  }
  EXPECT_NEAR(strip.AspectRatio, 6.0, 1e-12);
}

// A surface with slivers that have no angles in doubles still has a map without holes.
TEST(ConformalMap, Slivers)
{
  Mesh mesh = makeRectangle(10, 10);
  for (std::size_t i = 0; i < 11 * 11; ++i)
  {
    if (mesh.Points[i][0] > 0.45 && mesh.Points[i][0] < 0.55)
    {
      mesh.Points[i][0] = 0.4 + 1e-13;
    }
  }
  const ConformalMap map = mapped(DiskMesh(mesh.Surface()), sheetCorners(10, 10));
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    ASSERT_NEAR(map.Square.Positions[i][0], mesh.Points[i][0], 1e-6);
    ASSERT_NEAR(map.Square.Positions[i][1], mesh.Points[i][1], 1e-6);
  }
}

TEST(ConformalMap, ThreadsAndExecutors)
{
  const DiskMesh disk(makeTerrain(60, 50).Surface());
  const SquareCorners corners = chooseCorners(disk);
  const ConformalMap reference = mapConformally(disk, corners, serial);
  for (const int threads : { 1, 2, 3 })
  {
    const ConformalMap map = mapConformally(disk, corners, ThreadsExecutor(threads));
    EXPECT_TRUE(sameBits(map.Square.Positions, reference.Square.Positions)) << threads;
    EXPECT_EQ(map.AspectRatio, reference.AspectRatio);
  }
}

TEST(ConformalMap, ProgressAndCancel)
{
  const DiskMesh disk(makeTerrain(150, 150).Surface());
  const SquareCorners corners = chooseCorners(disk);
  const OpenMPExecutor threads;
  for (const Executor* executor :
    { static_cast<const Executor*>(&serial), static_cast<const Executor*>(&threads) })
  {
    RecordingContext whole(*executor);
    mapConformally(disk, corners, whole.Context());
    whole.ExpectReported(0.0, 1.0);
    ASSERT_GT(whole.Queries, 20);
    for (int maximum = 0; maximum < whole.Queries / 2; maximum += 1 + whole.Queries / 10)
    {
      RecordingContext recorder(*executor);
      recorder.MaximumQueries = maximum;
      EXPECT_THROW(mapConformally(disk, corners, recorder.Context()), Cancelled);
      EXPECT_GT(recorder.Queries, maximum);
      EXPECT_LE(recorder.Queries, maximum + 4);
    }
  }
}

} // namespace
} // namespace RectifiedTransport
