// SPDX-License-Identifier: BSD-3-Clause
// Points within edges of other triangles: which are found, that triangles are cut there and keep
// their areas, and what is no T-junction.
#include "Surfaces/Mesh/Repair/TJunctions.h"

#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/Progress.h"
#include "HangingNodes.h"
#include "SurfaceRelaxation/SurfaceMeasures.h"
#include "Surfaces/Mesh/Repair/SplitSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr double floatRounding = 4.0 * std::numeric_limits<float>::epsilon();

// A surface cut at its T-junctions.
struct Cut
{
  explicit Cut(const Mesh& mesh, double rounding = 0.0)
    : Given(mesh)
  {
    Progress progress{ Context() };
    std::vector<std::int64_t> merged(mesh.Points.size());
    mergePoints<3>(mesh.Points, merged.data());
    for (auto& triangle : this->Given.Triangles)
    {
      for (std::int64_t& point : triangle)
      {
        point = merged[static_cast<std::size_t>(point)];
      }
    }
    const TriangleSurface surface = this->Given.Surface();
    this->Junctions =
      findTJunctions(surface.Points, openSidesOf(surface, {}, progress), rounding, progress);
    this->Parts = std::make_unique<SplitSurface>(surface, this->Junctions, progress);
  }

  TriangleSurface Surface() const
  {
    return { this->Given.Points, this->Parts->Triangles(), this->Parts->NumberOfTriangles() };
  }
  std::size_t Open() const
  {
    Progress progress{ Context() };
    return openSidesOf(this->Surface(), {}, progress).size();
  }

  Mesh Given;
  std::vector<TJunction> Junctions;
  std::unique_ptr<SplitSurface> Parts;
};

// The parts of each given triangle turn as it does and have its area, and places on them are places
// on it.
void expectParts(const Cut& cut, double rounding = 1e-12)
{
  const TriangleSurface given = cut.Given.Surface();
  std::vector<double> areas(cut.Given.Triangles.size(), 0.0);
  for (std::int64_t t = 0; t < cut.Surface().NumberOfTriangles; ++t)
  {
    const std::int64_t origin = cut.Parts->GivenTriangle(t);
    ASSERT_TRUE(t == 0 || origin == cut.Parts->GivenTriangle(t - 1) ||
      origin == cut.Parts->GivenTriangle(t - 1) + 1);
    areas[static_cast<std::size_t>(origin)] += areaOf(cut.Surface(), t);
    const PlaceOnTriangle place{ t, { 0.2, 0.3, 0.5 } };
    const PlaceOnTriangle same = cut.Parts->GivenPlace(place);
    ASSERT_EQ(same.Triangle, origin);
    ASSERT_NEAR(same.Weights[0] + same.Weights[1] + same.Weights[2], 1.0, 1e-15);
    ASSERT_GE(*std::min_element(same.Weights.begin(), same.Weights.end()), 0.0);
    ASSERT_LE(std::sqrt(squaredDistance(positionOf(given, same), positionOf(cut.Surface(), place))),
      rounding);
    for (std::size_t i = 0; i < 3; ++i)
    {
      ASSERT_EQ(cut.Parts->GivenCorners(t)[i], given.Triangles[3 * origin + static_cast<int>(i)]);
    }
  }
  for (std::size_t t = 0; t < areas.size(); ++t)
  {
    const double area = areaOf(given, static_cast<std::int64_t>(t));
    ASSERT_NEAR(areas[t], area, 10.0 * rounding) << t;
  }
}

// Any numbers of points on three sides.
TEST(SplitTriangle, KeepsItsArea)
{
  const std::vector<Point<3>> corners{ { 0.0, 0.0, 0.0 }, { 1.0, 0.1, 0.0 }, { 0.3, 0.8, 0.0 } };
  for (int counts = 0; counts < 125; ++counts)
  {
    const int count[3] = { counts % 5, counts / 5 % 5, counts / 25 };
    std::vector<Point<3>> points = corners;
    std::array<SplitTriangle::Side, 3> sides;
    std::vector<int> sidesOf{ 0b101, 0b011, 0b110 }; // bit i: on side i
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (int k = 1; k <= count[i]; ++k)
      {
        const double part = k / (count[i] + 1.0);
        sides[i].push_back(static_cast<std::int64_t>(points.size()));
        points.push_back((1.0 - part) * corners[i] + part * corners[(i + 1) % 3]);
        sidesOf.push_back(1 << i);
      }
    }
    const SplitTriangle split(points, { 0, 1, 2 }, sides);
    EXPECT_EQ(split.Parts().size(), points.size() - 2);
    double area = 0.0;
    for (const auto& part : split.Parts())
    {
      const auto bits = [&](std::size_t i) { return sidesOf[static_cast<std::size_t>(part[i])]; };
      EXPECT_EQ(bits(0) & bits(1) & bits(2), 0) << counts;
      const auto at = [&](std::size_t i) { return points[static_cast<std::size_t>(part[i])]; };
      const double twice = cross(at(1) - at(0), at(2) - at(0))[2];
      EXPECT_GT(twice, 0.0) << counts;
      area += 0.5 * twice;
    }
    EXPECT_NEAR(area, 0.5 * cross(corners[1], corners[2])[2], 1e-15);
  }
}

// All three neighbours are half as large: four equal parts.
TEST(SplitTriangle, ShortEdges)
{
  const std::vector<Point<3>> points{ { 0.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0 }, { 0.0, 2.0, 0.0 },
    { 1.0, 0.0, 0.0 }, { 1.0, 1.0, 0.0 }, { 0.0, 1.0, 0.0 } };
  const SplitTriangle split(points, { 0, 1, 2 }, { { { 3 }, { 4 }, { 5 } } });
  for (const auto& part : split.Parts())
  {
    const auto at = [&](std::size_t i) { return points[static_cast<std::size_t>(part[i])]; };
    EXPECT_EQ(cross(at(1) - at(0), at(2) - at(0))[2], 1.0);
  }
}

TEST(TJunctions, OfABox)
{
  for (const std::int64_t quads : { 1, 3, 8 })
  {
    for (const std::int64_t ratio : { 1, 2, 4, 5 })
    {
      const Mesh box = makeRefinedBox(quads, ratio);
      const auto count = static_cast<std::size_t>(4 * quads * (ratio - 1));
      const Cut cut(box);
      EXPECT_EQ(cut.Junctions.size(), count);
      EXPECT_EQ(cut.Open(), 0u);
      expectParts(cut);
      for (const double distance : { 0.0, 100.0, 500000.0 })
      {
        const double size = distance > 1e4 ? 1000.0 : 1.0; // metres
        const Mesh far =
          farAwayInFloat(box.Mapped([size](const Point<3>& x) { return size * x; }), distance);
        const double rounding = floatRounding * (distance + 2.0 * size);
        const Cut farCut(far, rounding);
        EXPECT_EQ(farCut.Junctions.size(), count) << distance;
        EXPECT_EQ(farCut.Open(), 0u) << distance;
        expectParts(farCut, size * rounding);
      }
    }
  }
}

// Without the rounding of float, far away, most points are beside the edges.
TEST(TJunctions, OfDoublesAreOnEdges)
{
  EXPECT_EQ(Cut(farAwayInFloat(makeRefinedBox(20, 2), 500.0), 502.0 * floatRounding).Open(), 0u);
  const Cut cut(farAwayInFloat(makeRefinedBox(20, 2), 500.0));
  EXPECT_LT(cut.Junctions.size(), 60u);
  EXPECT_GT(cut.Open(), 60u);
}

TEST(TJunctions, OfAGlobe)
{
  const Cut cut(makeRefinedGlobe(30, 8, 4));
  EXPECT_EQ(cut.Junctions.size(), 30u * 3);
  EXPECT_EQ(cut.Open(), 0u);
  expectParts(cut);
}

// The points of each side lie within edges of the other one; some are the same.
TEST(TJunctions, OnBothSides)
{
  const Cut cut(makeZigzag({ 0.2, 0.3, 0.5, 0.9 }, { 0.1, 0.25, 0.5, 0.6, 0.7, 0.8 }));
  EXPECT_EQ(cut.Junctions.size(), 3u + 5);
  EXPECT_EQ(cut.Open(), 5u + 7 + 4);
  expectParts(cut);
}

// Many points on a line, in either order of the triangles.
TEST(TJunctions, ManyOnOneEdge)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit;
  std::vector<double> above(5000);
  std::generate(above.begin(), above.end(), [&]() { return unit(random); });
  std::sort(above.begin(), above.end());
  std::vector<double> below(50);
  std::generate(below.begin(), below.end(), [&]() { return unit(random); });
  std::sort(below.begin(), below.end());
  Mesh mesh = makeZigzag(below, above);
  for (int turn = 0; turn < 2; ++turn)
  {
    const Cut cut(mesh);
    EXPECT_EQ(cut.Junctions.size(), 5050u);
    EXPECT_EQ(cut.Open(), 5001u + 51 + 4);
    expectParts(cut);
    std::reverse(mesh.Triangles.begin(), mesh.Triangles.end());
  }
}

// The same parts for any order of the triangles and their corners.
TEST(TJunctions, AnyOrder)
{
  const Mesh box = makeRefinedBox(3, 4);
  const auto edgesOf = [](const Cut& cut) {
    std::multiset<std::array<Point<3>, 3>> triangles;
    for (std::int64_t t = 0; t < cut.Surface().NumberOfTriangles; ++t)
    {
      std::array<Point<3>, 3> corners{ cornerOf(cut.Surface(), t, 0), cornerOf(cut.Surface(), t, 1),
        cornerOf(cut.Surface(), t, 2) };
      std::sort(corners.begin(), corners.end());
      triangles.insert(corners);
    }
    return triangles;
  };
  const auto expected = edgesOf(Cut(box));
  std::mt19937_64 random(3);
  for (int i = 0; i < 5; ++i)
  {
    Mesh other = box;
    std::shuffle(other.Triangles.begin(), other.Triangles.end(), random);
    for (auto& triangle : other.Triangles)
    {
      std::rotate(
        triangle.begin(), triangle.begin() + static_cast<int>(random() % 3), triangle.end());
    }
    EXPECT_EQ(edgesOf(Cut(other)), expected);
  }
}

TEST(TJunctions, RoundingIsOfFloatIfAllAreFloats)
{
  Progress progress{ Context() };
  Mesh box = farAwayInFloat(makeRefinedBox(4, 2), 100.0);
  box.Points.push_back({ 1e30, 0.1, 0.0 }); // of no triangle
  const double far = roundingOfCorners(box.Surface(), progress);
  EXPECT_NEAR(far, 101.0 * floatRounding, floatRounding);
  box.Points[3][1] += 1e-9;
  EXPECT_NEAR(roundingOfCorners(box.Surface(), progress) / far,
    std::numeric_limits<double>::epsilon() / std::numeric_limits<float>::epsilon(), 1e-15);
}

// Three sheets with 1, 2 and 4 edges on one line.
TEST(TJunctions, OfThreeSheets)
{
  Mesh mesh;
  for (int leaf = 0; leaf < 3; ++leaf)
  {
    const double turn = 2.0 * pi * leaf / 3.0;
    mesh.Add(makeQuads(1, 1 << leaf, [=](double u, double v) {
      return Point<3>{ u * std::cos(turn), u * std::sin(turn), v };
    }));
  }
  const Cut cut(mesh);
  EXPECT_EQ(cut.Junctions.size(), 3u + 2);
  const SurfaceEdges edges(cut.Surface());
  EXPECT_EQ(edges.NonManifold(), 4);
  expectParts(cut);
}

// A slit that is open by more than rounding, at one end or all along.
TEST(TJunctions, SlitsStayOpen)
{
  const Mesh closed = makeZigzag({ 0.2, 0.4, 0.7 }, { 0.3, 0.6, 0.8 });
  for (const bool isWedge : { true, false })
  {
    for (const double width : { 1e-8, 9e-7, 1e-5, 1e-3, 0.1 })
    {
      Mesh slit = closed;
      for (std::size_t i = 10; i < slit.Points.size(); i += 2) // of the upper row
      {
        slit.Points[i][1] += isWedge ? width * slit.Points[i][0] : width;
      }
      EXPECT_EQ(Cut(slit).Junctions.size(), width < 1e-6 ? 6u : 0u) << width;
    }
  }
  // In float, by its rounding.
  EXPECT_EQ(Cut(farAwayInFloat(closed, 500.0), 502.0 * floatRounding).Junctions.size(), 6u);
  Mesh slit = closed;
  for (std::size_t i = 10; i < slit.Points.size(); i += 2)
  {
    slit.Points[i][1] += 3.0 * 502.0 * floatRounding;
  }
  EXPECT_TRUE(Cut(farAwayInFloat(slit, 500.0), 502.0 * floatRounding).Junctions.empty());
}

// Teeth whose tips touch an edge, and a point on an edge from which nothing goes along it.
TEST(TJunctions, TouchingIsNone)
{
  Mesh mesh;
  mesh.Points = { { 0, 0, 0 }, { 4, 0, 0 }, { 2, -1, 0 }, { 1, 0, 0 }, { 0.5, 1, 0 }, { 1.5, 1, 0 },
    { 3, 0, 0 }, { 2.5, 1, 1 }, { 3.5, 1, 0 } };
  mesh.Triangles = { { 0, 1, 2 }, { 3, 4, 5 }, { 6, 7, 8 } };
  EXPECT_TRUE(Cut(mesh).Junctions.empty());
  // A side between the tips.
  mesh.Triangles.push_back({ 3, 6, 7 });
  EXPECT_EQ(Cut(mesh).Junctions.size(), 2u);
}

// A point on two sides of a triangle without area cuts it once.
TEST(TJunctions, OnTwoSidesOfALine)
{
  Mesh mesh;
  mesh.Points = { { 0, 0, 0 }, { 4, 0, 0 }, { 2, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } };
  mesh.Triangles = { { 0, 1, 2 }, { 0, 3, 4 }, { 3, 2, 4 } };
  const Cut cut(mesh);
  EXPECT_EQ(cut.Junctions.size(), 1u);
  EXPECT_EQ(cut.Surface().NumberOfTriangles, 4);
}

TEST(TJunctions, OfNothing)
{
  EXPECT_TRUE(Cut(makeTorus(8, 6)).Junctions.empty());
  Mesh lines;
  lines.Points = { { 0, 0, 0 }, { 1, 0, 0 } };
  lines.Triangles = { { 0, 1, 1 } };
  EXPECT_TRUE(Cut(lines).Junctions.empty());
}

} // namespace
} // namespace RectifiedTransport
