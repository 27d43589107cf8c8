// SPDX-License-Identifier: BSD-3-Clause
// Maps that keep areas: of rectangles and annuli, whose maps are known, of curved surfaces by what
// they promise, and of surfaces for which there is no good one.
#include "DiskSurfaces.h"
#include "RecordingContext.h"
#include "SolidSurfaces.h"
#include "Surfaces/Parameterization/AreaPreservingMap.h"
#include "TestRefusal.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <set>

namespace RectifiedTransport
{
namespace
{

using Positions = std::vector<Point<2>>;

const SerialExecutor serial;

AreaPreservingOptions withResolution(std::int64_t resolution, bool polish = true)
{
  AreaPreservingOptions options;
  options.Resolution = resolution;
  options.Polish = polish;
  return options;
}

// All points are in the square, those of sides on their sides in their order, those of corners at
// their corners, and the areas of the triangles sum to 1.
void expectInSquare(const DiskMesh& disk, const SquareMap& square, const Positions& positions)
{
  ASSERT_EQ(positions.size(), square.Positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      ASSERT_GE(positions[i][axis], 0.0) << i;
      ASSERT_LE(positions[i][axis], 1.0) << i;
      if (square.OnSides[i] >> axis & 1)
      {
        ASSERT_EQ(positions[i][axis], square.Positions[i][axis]) << i;
      }
    }
  }
  double area = 0.0;
  for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
  {
    area += 0.5 * turnOf(disk, t, positions);
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
}

// With the flow alone but for its integrator.
TEST(AreaPreservingMap, FlatRectanglesStayAsTheyAre)
{
  for (const bool random : { false, true })
  {
    const Mesh mesh = random ? makeRandomTriangulation(20, 16, 1e-4) : makeRectangle(20, 16);
    const DiskMesh disk(
      mesh.Mapped([](const Point<3>& p) {
            return Point<3>{ 3.0 * p[0], p[1], p[2] };
          })
        .Surface());
    const SquareMap square = mapped(disk, sheetCorners(20, 16)).Square;
    const AreaPreservingMap map = mapAreaPreserving(disk, square, withResolution(64));
    EXPECT_EQ(map.Positions, square.Positions);
    EXPECT_EQ(map.Sweeps, 0);
    EXPECT_EQ(map.Flows, 0);
    const AreaPreservingMap flow = mapAreaPreserving(disk, square, withResolution(64, false));
    EXPECT_LT(largestDifference(flow.Positions, square.Positions), 3e-5);
    EXPECT_LT(flow.Distortion.AreaRootMeanSquare, 3e-4);
    EXPECT_EQ(flow.Flows, 1);
  }
}

// By the flow's limit on the sides themselves the triangles there would shear: 3.4 in the mean.
TEST(AreaPreservingMap, SidesMoveAsTheirNeighbours)
{
  const Mesh mesh = makeTerrain(60, 60).Mapped([](const Point<3>& p) {
    return Point<3>{ p[0], p[1], 1.5 * p[2] };
  });
  const DiskMesh disk(mesh.Surface());
  const SquareMap square = mapped(disk, sheetCorners(60, 60)).Square;
  const AreaPreservingMap map = mapAreaPreserving(disk, square, withResolution(512, false));
  EXPECT_LT(map.Distortion.AngleMean, 2.5);
}

struct FlowErrors // the largest ones
{
  double Inside = 0.0;
  double OnSides = 0.0;
};

// Of the flow alone, where the radius' square and the angle are the coordinates.
FlowErrors annulusErrors(std::int64_t cells, std::int64_t resolution)
{
  constexpr double radius = 3.0;
  const Mesh mesh = makeQuarterAnnulus(radius, cells, 2 * cells);
  const DiskMesh disk(mesh.Surface());
  const SquareMap square = mapped(disk, sheetCorners(cells, 2 * cells)).Square;
  const AreaPreservingMap map = mapAreaPreserving(disk, square, withResolution(resolution, false));
  EXPECT_EQ(map.Sweeps, 0);
  EXPECT_EQ(map.Flows, 1);
  expectInSquare(disk, square, map.Positions);
  FlowErrors errors;
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    const Point<3>& p = mesh.Points[i];
    const Point<2> truth{ (p[0] * p[0] + p[1] * p[1] - 1.0) / (radius * radius - 1.0),
      std::atan2(p[1], p[0]) / (0.5 * pi) };
    double& largest = square.OnSides[i] == 0 ? errors.Inside : errors.OnSides;
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      largest = std::max(largest, std::abs(map.Positions[i][axis] - truth[axis]));
    }
  }
  return errors;
}

TEST(AreaPreservingMap, FlowOfAQuarterAnnulus)
{
  // The mesh's error is far below the grid's, which is of second order.
  const FlowErrors coarseGrid = annulusErrors(48, 8);
  const FlowErrors fineGrid = annulusErrors(48, 32);
  EXPECT_LT(coarseGrid.Inside, 0.01);
  EXPECT_LT(fineGrid.Inside, coarseGrid.Inside / 10.0);
  EXPECT_LT(coarseGrid.OnSides, 0.01);
  EXPECT_LT(fineGrid.OnSides, coarseGrid.OnSides / 10.0);
  // The other way. Of sides, the flow sees the triangles there only, which are never quite even: of
  // first order.
  const FlowErrors coarseMesh = annulusErrors(6, 400);
  const FlowErrors fineMesh = annulusErrors(24, 400);
  EXPECT_LT(coarseMesh.Inside, 0.002);
  EXPECT_LT(fineMesh.Inside, coarseMesh.Inside / 10.0);
  EXPECT_LT(coarseMesh.OnSides, 0.02);
  EXPECT_LT(fineMesh.OnSides, coarseMesh.OnSides / 3.5);
}

// The goals that are reached, and by far less than what a conformal map has.
void expectEven(const Mesh& mesh, std::int64_t resolution, const char* name)
{
  const DiskMesh disk(mesh.Surface());
  const SquareMap square = mapped(disk).Square;
  const AreaPreservingMap map = mapAreaPreserving(disk, square, withResolution(resolution));
  const MapDistortion before = measureDistortion(disk, square.Positions);
  const MapDistortion& after = map.Distortion;
  EXPECT_LT(after.AreaMedian, 0.01) << name;
  EXPECT_LT(after.Area95, 0.05) << name;
  EXPECT_LT(after.AreaRootMeanSquare, 0.03) << name;
  EXPECT_LT(after.AreaRootMeanSquare, 0.1 * before.AreaRootMeanSquare) << name;
  EXPECT_EQ(after.Flipped, 0) << name;
  expectInSquare(disk, square, map.Positions);
  // What is reported is what there is.
  const MapDistortion measured = measureDistortion(disk, map.Positions);
  EXPECT_EQ(after.AreaRootMeanSquare, measured.AreaRootMeanSquare) << name;
  EXPECT_EQ(after.AreaMedian, measured.AreaMedian) << name;
  EXPECT_EQ(after.Area95, measured.Area95) << name;
  EXPECT_EQ(after.AngleMean, measured.AngleMean) << name;
}

TEST(AreaPreservingMap, Hemisphere)
{
  expectEven(makeCap(20, 0.5 * pi), 128, "hemisphere");
  expectEven(renumber(makeCap(12, 0.8 * pi)).Surface, 128, "most of a sphere");
}

TEST(AreaPreservingMap, Terrain)
{
  expectEven(makeTerrain(40, 40), 128, "terrain");
  expectEven(makeTerrain(70, 15), 100, "with long triangles");
}

TEST(AreaPreservingMap, Annulus)
{
  expectEven(makeQuarterAnnulus(5.0, 20, 30), 128, "annulus");
}

TEST(AreaPreservingMap, WhateverThePlaceAndTheSize)
{
  const Mesh mesh = makeTerrain(20, 20);
  const std::vector<std::int64_t> corners = sheetCorners(20, 20);
  const auto positionsOf = [&corners](const Mesh& other) {
    const DiskMesh disk(other.Surface());
    return mapAreaPreserving(disk, mapped(disk, corners).Square, withResolution(64)).Positions;
  };
  const auto scaled = [&mesh](double scale) {
    return mesh.Mapped([scale](const Point<3>& p) {
      return Point<3>{ scale * p[0], scale * p[1], scale * p[2] };
    });
  };
  const Positions reference = positionsOf(mesh);
  EXPECT_TRUE(sameBits(positionsOf(scaled(0x1p-500)), reference));
  EXPECT_TRUE(sameBits(positionsOf(scaled(0x1p500)), reference));
  EXPECT_LT(largestDifference(positionsOf(scaled(1e-150)), reference), 1e-8);
  EXPECT_LT(largestDifference(positionsOf(scaled(1e150)), reference), 1e-8);
  EXPECT_LT(largestDifference(positionsOf(turned(mesh)), reference), 1e-8);
}

// Where sweeps are still far from even areas the flow is run again, and the goals are reached
// though each tenth triangle of the conformal map is flipped.
TEST(AreaPreservingMap, Towers)
{
  const Mesh towers = makeSheet(60, 60, [](double u, double v) {
    return Point<3>{ u, v, std::tanh(20.0 * std::sin(9.0 * u) * std::sin(7.0 * v)) };
  });
  const DiskMesh disk(towers.Surface());
  const SquareMap square = mapped(disk).Square;
  EXPECT_GT(measureDistortion(disk, square.Positions).Flipped, 200);
  const AreaPreservingMap map = mapAreaPreserving(disk, square, withResolution(32));
  EXPECT_GT(map.Flows, 1);
  EXPECT_LT(map.Distortion.AreaMedian, 0.01);
  EXPECT_LT(map.Distortion.Area95, 0.05);
  EXPECT_LT(map.Distortion.AreaRootMeanSquare, 0.03);
  EXPECT_EQ(map.Distortion.Flipped, 0);
  expectInSquare(disk, square, map.Positions);
}

// From another corner on the map is turned, and that of a mirrored surface is mirrored: no side is
// treated otherwise.
TEST(AreaPreservingMap, TurnsWithTheCorners)
{
  const Mesh mesh = makeTerrain(30, 30);
  const DiskMesh disk(mesh.Surface());
  std::vector<std::int64_t> corners = sheetCorners(30, 30);
  const auto flow = [&]() {
    return mapAreaPreserving(disk, mapped(disk, corners).Square, withResolution(96, false));
  };
  Positions expected = flow().Positions;
  for (int quarter = 1; quarter < 4; ++quarter)
  {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    for (Point<2>& position : expected)
    {
      position = { position[1], 1.0 - position[0] };
    }
    EXPECT_LT(largestDifference(flow().Positions, expected), 1e-5) << quarter;
  }
}

TEST(AreaPreservingMap, ThreadsAndExecutors)
{
  const DiskMesh disk(makeTerrain(80, 80).Surface()); // two tiles
  const SquareMap square = mapped(disk).Square;
  const AreaPreservingMap reference = mapAreaPreserving(disk, square, withResolution(64), serial);
  EXPECT_GT(reference.Sweeps, 0);
  for (const int threads : { 1, 2, 3 })
  {
    const AreaPreservingMap map =
      mapAreaPreserving(disk, square, withResolution(64), ThreadsExecutor(threads));
    EXPECT_TRUE(sameBits(map.Positions, reference.Positions)) << threads;
    EXPECT_EQ(map.Sweeps, reference.Sweeps);
    EXPECT_EQ(map.Distortion.AreaRootMeanSquare, reference.Distortion.AreaRootMeanSquare);
    EXPECT_EQ(map.Distortion.Area95, reference.Distortion.Area95);
  }
}

TEST(AreaPreservingMap, Refused)
{
  const DiskMesh disk(makeRectangle(3, 3).Surface());
  const SquareMap square = mapped(disk).Square;
  const auto refused = [&](std::int64_t resolution) {
    return refusal([&]() { mapAreaPreserving(disk, square, withResolution(resolution)); });
  };
  EXPECT_EQ(refused(0), "Resolution is 0; it must be from 1 to 16384");
  EXPECT_EQ(refused(-512), "Resolution is -512; it must be from 1 to 16384");
  EXPECT_EQ(refused(16385), "Resolution is 16385; it must be from 1 to 16384");
  EXPECT_LT(mapAreaPreserving(disk, square, withResolution(1)).Distortion.Area95, 3e-4);
}

TEST(AreaPreservingMap, FewTriangles)
{
  // The corners are all that there is.
  const Mesh pair{ { { 0, 0, 0 }, { 1, 0, 0 }, { 3, 3, 0 }, { 0, 1, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 } } };
  const DiskMesh two(pair.Surface());
  const AreaPreservingMap map =
    mapAreaPreserving(two, mapped(two, { 0, 1, 2, 3 }).Square, withResolution(32));
  EXPECT_EQ(map.Positions, (Positions{ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }));
  EXPECT_EQ(map.Distortion.Flipped, 0);

  // One point on a side, which has one place where the areas are right.
  const Mesh fan{ { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 3, 0 }, { 1, 3, 0 }, { 0, 3, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 } } };
  const DiskMesh three(fan.Surface());
  const AreaPreservingMap found =
    mapAreaPreserving(three, mapped(three, { 0, 1, 2, 4 }).Square, withResolution(32));
  EXPECT_NEAR(found.Positions[3][0], 0.25, 1e-3);
  EXPECT_EQ(found.Positions[3][1], 1.0);
  EXPECT_LT(found.Distortion.Area95, 5e-3);
}

// A sphere but for two triangles, whose points are moved to within a part of their distances.
Mesh makeOpenSphere(double part)
{
  Mesh sphere = makeSphere({ 0, 0, 0 }, 1.0, 14);
  const auto first =
    sphere.Triangles.begin() + static_cast<std::ptrdiff_t>(sphere.Triangles.size() / 2) / 2 * 2;
  std::set<std::int64_t> points(first[0].begin(), first[0].end());
  points.insert(first[1].begin(), first[1].end());
  EXPECT_EQ(points.size(), 4u) << "triangles without an edge in common";
  const Point<3> centre = sphere.Points[static_cast<std::size_t>(*points.begin())];
  for (const std::int64_t id : points)
  {
    Point<3>& point = sphere.Points[static_cast<std::size_t>(id)];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = centre[axis] + part * (point[axis] - centre[axis]);
    }
  }
  sphere.Triangles.erase(first, first + 2);
  return sphere;
}

// All points of the boundary are corners.
TEST(AreaPreservingMap, NearlyClosed)
{
  for (const double part : { 1.0, 0.1, 1e-3, 1e-6 })
  {
    const DiskMesh disk(makeOpenSphere(part).Surface());
    ASSERT_EQ(disk.Boundary().size(), 4u);
    const SquareMap square = mapped(disk).Square;
    const AreaPreservingMap map = mapAreaPreserving(disk, square, withResolution(128));
    expectInSquare(disk, square, map.Positions);
    EXPECT_LT(map.Distortion.AreaRootMeanSquare, 0.03) << part;
    EXPECT_EQ(map.Distortion.Flipped, 0) << part;
  }
}

// Most of the area is in the few triangles of a spot in the middle, and the rest of them is around
// the opposite pole: no good map is known, but one that is finite, in finite time.
TEST(AreaPreservingMap, NearlyClosedAndGraded)
{
  for (const double scale : { 10.0, 1e3, 1e6 })
  {
    const Mesh sphere = makeRound(20, [scale](double radius, double angle) {
      const double polar = 2.0 * std::atan(scale * radius);
      return Point<3>{ std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
        std::cos(polar) };
    });
    const DiskMesh disk(sphere.Surface());
    const SquareMap square = mapped(disk).Square;
    const AreaPreservingMap map = mapAreaPreserving(disk, square, withResolution(128));
    expectInSquare(disk, square, map.Positions);
    EXPECT_TRUE(std::isfinite(map.Distortion.AreaRootMeanSquare)) << scale;
    EXPECT_LT(map.Distortion.AreaRootMeanSquare,
      measureDistortion(disk, square.Positions).AreaRootMeanSquare)
      << scale;
  }
}

// More triangles at the boundary than corners: these have no area, the others what is left.
TEST(AreaPreservingMap, CollapsedTriangles)
{
  const Mesh mesh = makeTerrain(12, 12);
  const DiskMesh disk(mesh.Surface());
  const SquareCorners corners = orderCorners(disk, { 3, 7, 160, 165 });
  ASSERT_GT(countCollapsed(disk, corners), 0);
  const SquareMap square = mapConformally(disk, corners).Square;
  const AreaPreservingMap map = mapAreaPreserving(disk, square, withResolution(64));
  expectInSquare(disk, square, map.Positions);
  EXPECT_EQ(map.Distortion.Flipped, countCollapsed(disk, corners));
  EXPECT_LT(map.Distortion.AreaMedian, 0.05);
}

TEST(AreaPreservingMap, Progress)
{
  const DiskMesh disk(makeTerrain(40, 40).Surface());
  const SquareMap square = mapped(disk).Square;
  for (const bool polish : { false, true })
  {
    RecordingContext whole(serial);
    mapAreaPreserving(disk, square, withResolution(64, polish), whole.Context());
    EXPECT_LT(whole.Reported.front(), 0.3);
    EXPECT_GT(whole.Reported.size(), 5u);
    whole.ExpectReported(0.0, 1.0);
  }
}

// From whichever progress on it is cancelled.
TEST(AreaPreservingMap, Cancelled)
{
  const DiskMesh disk(makeTerrain(30, 30).Surface());
  const SquareMap square = mapped(disk).Square;
  for (int percent = 0; percent < 100; percent += 4)
  {
    for (const bool isSerial : { true, false })
    {
      const ThreadsExecutor threads(isSerial ? 1 : 3);
      std::atomic<double> reached{ -1.0 };
      std::atomic<int> stops{ 0 };
      const Context context(
        threads, [&reached](double done) { reached = done; },
        [&]() {
          const bool stop = reached >= 0.01 * percent;
          stops += stop ? 1 : 0;
          return stop;
        });
      EXPECT_THROW(mapAreaPreserving(disk, square, withResolution(64), context), Cancelled)
        << percent;
      EXPECT_LE(stops, 50) << percent;
    }
  }
}

// After any number of queries.
TEST(AreaPreservingMap, CancelledAfterQueries)
{
  const DiskMesh disk(makeTerrain(30, 30).Surface());
  const SquareMap square = mapped(disk).Square;
  RecordingContext whole(serial);
  mapAreaPreserving(disk, square, withResolution(64), whole.Context());
  ASSERT_GT(whole.Queries, 15);
  // Slices, and with them queries, are fewer on a slower day.
  for (int maximum = 0; maximum < whole.Queries / 2; ++maximum)
  {
    RecordingContext recorder(serial);
    recorder.MaximumQueries = maximum;
    EXPECT_THROW(
      mapAreaPreserving(disk, square, withResolution(64), recorder.Context()), Cancelled);
    EXPECT_LE(recorder.Queries, maximum + 50);
  }
}

} // namespace
} // namespace RectifiedTransport
