// SPDX-License-Identifier: BSD-3-Clause
// The intrinsic Delaunay triangulation: of flat surfaces against the plane, of others by what flips
// must keep, and of triangles that are as good as none.
#include "DiskSurfaces.h"

#include "Surfaces/Parameterization/IntrinsicDelaunay.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

using Edge = std::pair<std::int64_t, std::int64_t>;

struct EdgeWeight
{
  double Sum = 0.0;     // of the cotangents opposite to it
  double Largest = 0.0; // of their absolute values
  int Sides = 0;
};

std::map<Edge, EdgeWeight> weightsOf(const IntrinsicTriangles& triangles)
{
  std::map<Edge, EdgeWeight> weights;
  for (std::int64_t t = 0; t < triangles.Points.size(); ++t)
  {
    const auto& corners = triangles.Points.data()[t];
    const auto cotangents = triangles.Cotangents(t);
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_TRUE(std::isfinite(cotangents[i]));
      EdgeWeight& weight = weights[std::minmax(corners[i], corners[(i + 1) % 3])];
      weight.Sum += cotangents[i];
      weight.Largest = std::max(weight.Largest, std::abs(cotangents[i]));
      ++weight.Sides;
    }
  }
  return weights;
}

// No weight inside of the surface is negative, but for rounding.
void expectDelaunay(const IntrinsicTriangles& triangles)
{
  for (const auto& [edge, weight] : weightsOf(triangles))
  {
    if (weight.Sides > 1)
    {
      ASSERT_GE(weight.Sum, -1e-9 * (1.0 + weight.Largest)) << edge.first << " to " << edge.second;
    }
  }
}

double areaOf(const std::array<double, 3>& l)
{
  const double half = 0.5 * (l[0] + l[1] + l[2]);
  return std::sqrt(std::max(0.0, half * (half - l[0]) * (half - l[1]) * (half - l[2])));
}

double totalArea(const IntrinsicTriangles& triangles)
{
  return std::accumulate(triangles.Lengths.data(),
    triangles.Lengths.data() + triangles.Lengths.size(), 0.0,
    [](double sum, const auto& lengths) { return sum + areaOf(lengths); });
}

// Sides are as long as their points are apart, triangles turn left and cover the region once, and
// the triangulation is Delaunay.
void expectFlatDelaunay(const DiskMesh& disk)
{
  const IntrinsicTriangles triangles = triangulateDelaunay(disk);
  const ConstPointSpan<3> points = disk.Surface().Points;
  const auto at = [&](std::int64_t id) {
    return Point<3>{ points[id][0], points[id][1], points[id][2] };
  };
  ASSERT_EQ(triangles.Points.size(), disk.NumberOfTriangles());
  double area = 0.0;
  for (std::int64_t t = 0; t < triangles.Points.size(); ++t)
  {
    const auto& corners = triangles.Points.data()[t];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Point<3> a = at(corners[i]);
      const Point<3> b = at(corners[(i + 1) % 3]);
      ASSERT_NEAR(triangles.Lengths.data()[t][i], std::hypot(b[0] - a[0], b[1] - a[1]), 1e-9);
    }
    const double twice = turn(at(corners[0]), at(corners[1]), at(corners[2]));
    ASSERT_GT(twice, 0.0);
    area += 0.5 * twice;
  }
  EXPECT_NEAR(area, disk.Area(), 1e-12);
  expectDelaunay(triangles);
  for (const auto& [edge, weight] : weightsOf(triangles))
  {
    ASSERT_LE(weight.Sides, 2);
  }
}

TEST(IntrinsicDelaunay, FlatRegions)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    expectFlatDelaunay(DiskMesh(makeRandomTriangulation(12, 9, 1e-4, seed).Surface()));
  }
  expectFlatDelaunay(DiskMesh(makeRandomTriangulation(60, 60, 1e-5).Surface()));
  Mesh disk = makeRoundDisk(12);
  flipEdges(disk, 20000, 1e-3);
  expectFlatDelaunay(DiskMesh(disk.Surface()));
}

// A sheared grid takes many flips of every edge.
TEST(IntrinsicDelaunay, ShearedGrid)
{
  const Mesh sheared = makeSheet(200, 20, [](double u, double v) {
    return Point<3>{ 10.0 * u + 4.0 * v, v, 0.0 };
  });
  expectFlatDelaunay(DiskMesh(sheared.Surface()));
}

// Also where four points are on a circle, and no flip is better.
TEST(IntrinsicDelaunay, StaysAsItIs)
{
  for (const Mesh& mesh : { makeRectangle(20, 10, 2.0, 1.0), makeRoundDisk(9), makeCap(9, 0.2) })
  {
    const DiskMesh disk(mesh.Surface());
    const IntrinsicTriangles triangles = triangulateDelaunay(disk);
    const ConstPointSpan<3> points = disk.Surface().Points;
    for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        ASSERT_EQ(triangles.Points.data()[t][i], disk.Triangle(t)[i]);
        const double* a = points[disk.Triangle(t)[i]];
        const double* b = points[disk.Triangle(t)[(i + 1) % 3]];
        ASSERT_NEAR(
          triangles.Lengths.data()[t][i], std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]), 1e-15);
      }
    }
  }
}

// Flips keep the surface, and with it its area; cotangents are those of the angles.
TEST(IntrinsicDelaunay, CurvedSurfaces)
{
  // Flattened along one axis, so that triangles are bad.
  const Mesh hills = makeTerrain(40, 40).Mapped([](const Point<3>& p) {
    return Point<3>{ p[0], 0.15 * p[1], p[2] };
  });
  for (const Mesh& mesh : { hills, makeCap(20, 3.0) })
  {
    const DiskMesh disk(mesh.Surface());
    const IntrinsicTriangles triangles = triangulateDelaunay(disk);
    EXPECT_NEAR(totalArea(triangles), disk.Area(), 1e-9 * disk.Area());
    expectDelaunay(triangles);
    for (std::int64_t t = 0; t < triangles.Points.size(); ++t)
    {
      const auto& l = triangles.Lengths.data()[t];
      const auto cotangents = triangles.Cotangents(t);
      for (std::size_t i = 0; i < 3; ++i)
      {
        const double b = l[(i + 1) % 3];
        const double c = l[(i + 2) % 3];
        const double angle = std::acos((b * b + c * c - l[i] * l[i]) / (2.0 * b * c));
        ASSERT_NEAR(std::atan2(1.0, cotangents[i]), angle, 1e-6);
      }
    }
  }
}

// Points next to edges, by far less than lengths of sides tell: all weights are finite, none that
// matters is negative.
TEST(IntrinsicDelaunay, Slivers)
{
  for (const double height : { 1e-5, 1e-8, 1e-12, 1e-15 })
  {
    Mesh mesh = makeRandomTriangulation(10, 10, 1e-3);
    // A point in the middle of a side of each third triangle, moved inside by the height.
    const std::size_t triangles = mesh.Triangles.size();
    for (std::size_t t = 0; t < triangles; t += 3)
    {
      const auto corners = mesh.Triangles[t];
      const auto id = static_cast<std::int64_t>(mesh.Points.size());
      Point<3> point;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const auto at = [&](std::size_t i) {
          return mesh.Points[static_cast<std::size_t>(corners[i])][axis];
        };
        point[axis] = 0.5 * (1.0 - height) * (at(0) + at(1)) + height * at(2);
      }
      mesh.Points.push_back(point);
      mesh.Triangles[t] = { corners[0], corners[1], id };
      mesh.Triangles.push_back({ corners[1], corners[2], id });
      mesh.Triangles.push_back({ corners[2], corners[0], id });
    }
    // Some of these have no area at all in doubles.
    const Mesh skew = turned(mesh);
    try
    {
      expectDelaunay(triangulateDelaunay(DiskMesh(skew.Surface())));
    }
    catch (const NotADisk& defect)
    {
      EXPECT_EQ(defect.Defect(), DiskDefect::TrianglesWithoutArea);
      EXPECT_LT(height, 1e-14);
    }
  }
}

TEST(IntrinsicDelaunay, Cancelled)
{
  const DiskMesh disk(makeRectangle(200, 200).Surface());
  const SerialExecutor serial;
  int queries = 0;
  const Context context(serial, {}, [&queries]() { return ++queries > 1; });
  EXPECT_THROW(triangulateDelaunay(disk, context), Cancelled);
  EXPECT_EQ(queries, 2);
}

} // namespace
} // namespace RectifiedTransport
