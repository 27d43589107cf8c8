// SPDX-License-Identifier: BSD-3-Clause
// Triangles that points are placed on: those of a disk that is cut at T-junctions, and all of a
// surface of any shape.
#include "HangingNodes.h"
#include "SolidSurfaces.h"
#include "Surfaces/Mesh/AllTriangles.h"
#include "Surfaces/Mesh/DiskTriangles.h"
#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace RectifiedTransport
{
namespace
{

LargeBuffer<double> pointsOf(const Mesh& mesh)
{
  LargeBuffer<double> points(static_cast<std::int64_t>(3 * mesh.Points.size()));
  std::copy_n(mesh.Points[0].data(), points.size(), points.data());
  return points;
}

LargeBuffer<std::int64_t> cornersOf(const Mesh& mesh)
{
  LargeBuffer<std::int64_t> corners(static_cast<std::int64_t>(3 * mesh.Triangles.size()));
  std::copy_n(mesh.Triangles[0].data(), corners.size(), corners.data());
  return corners;
}

SurfaceTriangles read(const Mesh& mesh)
{
  return { pointsOf(mesh), cornersOf(mesh), 0.0 };
}

AllTriangles whole(const Mesh& mesh, const AllTriangles::IsLeftOut& isLeftOut = nullptr)
{
  Progress progress{ Context() };
  return { pointsOf(mesh), cornersOf(mesh), isLeftOut, progress };
}

// A unit square of two triangles below and of four above y = 1, where a point lies within the side
// of the triangle below.
Mesh makeHangingSheet()
{
  return { { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 0, 2, 0 },
             { 2, 2, 0 } },
    { { 0, 1, 3 }, { 0, 3, 2 }, { 2, 4, 5 }, { 4, 6, 5 }, { 4, 3, 6 } } };
}

// Where a place is by its given triangle, and by the triangles that were made of it.
void expectPlaces(const Mesh& mesh, const TriangleDomain& triangles)
{
  const double unit = triangles.Areas().Unit;
  const TriangleSurface surface = triangles.Surface();
  const std::array<double, 3> weights{ 0.5, 0.3, 0.2 };
  double area = 0.0;
  std::vector<Point<3>> offsets;
  for (std::int64_t t = 0; t < triangles.NumberOfTriangles(); ++t)
  {
    area += triangles.Areas().Shares[t];
    const PointWeights in = triangles.InGiven({ t, weights });
    const auto& given = mesh.Triangles[static_cast<std::size_t>(triangles.GivenTriangle(t))];
    Point<3> offset{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_EQ(std::count(given.begin(), given.end(), in.Points[i]), 1) << t;
      const std::int64_t corner = surface.Triangles[3 * t + static_cast<std::int64_t>(i)];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        offset[axis] += in.Weights[i] * mesh.Points[static_cast<std::size_t>(in.Points[i])][axis] -
          weights[i] * unit * surface.Points[corner][axis];
      }
    }
    offsets.push_back(offset); // the centre of the bounds
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
  for (const Point<3>& offset : offsets)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(offset[axis], offsets.front()[axis], 1e-12);
    }
  }
}

TEST(DiskTriangles, ATJunctionIsCutAndPlacesAreOnGivenTriangles)
{
  const Mesh mesh = makeHangingSheet();
  SurfaceTriangles triangles = read(mesh);
  Progress progress{ Context() };
  const DiskTriangles disk(triangles, progress);
  EXPECT_EQ(triangles.TJunctions(), 1);
  EXPECT_EQ(disk.NumberOfTriangles(), 6);
  std::int64_t parts = 0;
  for (std::int64_t t = 0; t < 6; ++t)
  {
    parts += disk.IsPart(t) ? 1 : 0;
    EXPECT_EQ(disk.IsPart(t), disk.GivenTriangle(t) == 1);
  }
  EXPECT_EQ(parts, 2);
  EXPECT_NEAR(disk.Areas().Total * disk.Areas().Unit * disk.Areas().Unit, 4.0, 1e-12);
  triangles.FreePoints();
  expectPlaces(mesh, disk);
}

TEST(DiskTriangles, DefectsNameGivenTriangles)
{
  SurfaceTriangles ball = read(makeSphere({ 0, 0, 0 }, 1.0, 8));
  Progress progress{ Context() };
  try
  {
    const DiskTriangles disk(ball, progress);
    ADD_FAILURE();
  }
  catch (const DiskTriangles::NoDisk& defect)
  {
    EXPECT_EQ(defect.Defect(), DiskDefect::Closed);
    EXPECT_EQ(defect.GivenTriangle, -1);
  }
  SurfaceTriangles line =
    read({ { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 } } });
  try
  {
    const DiskTriangles disk(line, progress);
    ADD_FAILURE();
  }
  catch (const DiskTriangles::NoDisk& defect)
  {
    EXPECT_EQ(defect.Count(), 2);
    EXPECT_EQ(defect.GivenTriangle, 0);
  }
}

TEST(AllTriangles, RepeatedAndUnwantedTrianglesAreLeftOut)
{
  Mesh mesh = makeBox({ 0, 0, 0 }, { 1, 2, 3 });
  const auto count = static_cast<std::int64_t>(mesh.Triangles.size());
  const AllTriangles plain = whole(mesh);
  EXPECT_EQ(plain.NumberOfTriangles(), count);
  EXPECT_NEAR(plain.Areas().Total * 9.0, 22.0, 1e-12);
  EXPECT_EQ(plain.Areas().Unit, 3.0);
  expectPlaces(mesh, plain);

  mesh.Triangles.push_back({ mesh.Triangles[3][2], mesh.Triangles[3][0], mesh.Triangles[3][1] });
  const AllTriangles some = whole(mesh, [](std::int64_t triangle) { return triangle == 1; });
  EXPECT_EQ(some.Repeated(), 1);
  EXPECT_EQ(some.NumberOfTriangles(), count - 1);
  EXPECT_EQ(some.GivenTriangle(0), 0);
  EXPECT_EQ(some.GivenTriangle(1), 2);
  expectPlaces(mesh, some);
}

TEST(AllTriangles, WhatHasNoAreaIsRefused)
{
  const Mesh line{ { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { { 0, 1, 2 } } };
  EXPECT_EQ(refusal([&]() { whole(line); }),
    "has no area: each of its 1 triangles has corners at one place or on one line");
  EXPECT_EQ(refusal([&]() { whole(line, [](std::int64_t) { return true; }); }),
    "has only ghost cells: all 1 triangles are duplicates, blanked or refined");
}

} // namespace
} // namespace RectifiedTransport
