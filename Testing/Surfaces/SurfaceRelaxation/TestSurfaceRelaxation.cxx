// SPDX-License-Identifier: BSD-3-Clause
// Points spread evenly over surfaces of all kinds: how far apart the nearest ones are, and how many
// are in patches and along boundaries.
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include "SurfaceRelaxation/SurfaceMeasures.h"
#include "SurfaceRelaxation/Surfaces.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

namespace RectifiedTransport
{
namespace
{

SurfaceRelaxationOptions optionsFor(std::int64_t samples, std::uint64_t seed = 1)
{
  SurfaceRelaxationOptions options;
  options.NumberOfSamples = samples;
  options.RandomSeed = seed;
  return options;
}

void expectPlaces(
  const TriangleSurface& surface, const SurfaceRelaxation& relaxed, std::int64_t count)
{
  ASSERT_EQ(relaxed.Places.size(), count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const PlaceOnTriangle& place = relaxed.Places.data()[i];
    ASSERT_GE(place.Triangle, 0);
    ASSERT_LT(place.Triangle, surface.NumberOfTriangles);
    ASSERT_GE(*std::min_element(place.Weights.begin(), place.Weights.end()), 0.0);
    ASSERT_NEAR(place.Weights[0] + place.Weights[1] + place.Weights[2], 1.0, 1e-15);
    ASSERT_GT(areaOf(surface, place.Triangle), 0.0);
  }
}

Points3 relaxed(const Mesh& mesh, const SurfaceRelaxationOptions& options)
{
  const SurfaceRelaxation result = relaxOnSurface(mesh.Surface(), {}, options);
  expectPlaces(mesh.Surface(), result, options.NumberOfSamples);
  return positionsOf(mesh.Surface(), result.Places);
}

struct Expected
{
  double Mean = 0.9;
  double Least = 0.7;
  double Patches = 0.03;
};

void expectEven(const Mesh& mesh, std::int64_t samples, const Expected& expected = {},
  double massPointsASample = 40.0)
{
  const Points3 points = relaxed(mesh, optionsFor(samples));
  const Spacing spacing = spacingOf(mesh.Surface(), points);
  EXPECT_GT(spacing.Mean, expected.Mean);
  EXPECT_GT(spacing.Least, expected.Least);
  const auto masses = massPoints(mesh.Surface(), massPointsASample * static_cast<double>(samples));
  EXPECT_LT(patchError(masses, points), expected.Patches);
}

TEST(SurfaceRelaxation, Sphere)
{
  expectEven(makeGlobe(100, 50), 4096);
}

TEST(SurfaceRelaxation, Torus)
{
  expectEven(makeTorus(120, 60), 4096);
}

TEST(SurfaceRelaxation, Box)
{
  expectEven(makeBox(12, { 1.0, 0.7, 0.5 }), 4096);
}

// The seam of a texture, everywhere: no two triangles share a point.
TEST(SurfaceRelaxation, SeparateTriangles)
{
  const Mesh torus = makeTorus(60, 30);
  expectEven(separated(torus), 4096);
  const SurfaceRelaxation result = relaxOnSurface(separated(torus).Surface(), {}, optionsFor(10));
  EXPECT_EQ(result.OpenEdges, 0);
  EXPECT_EQ(result.WeldedPoints, 3 * 3600 - 1800);
}

TEST(SurfaceRelaxation, ThreeLeaves)
{
  const Mesh leaves = makeLeaves(3, 16);
  expectEven(leaves, 4096);
  EXPECT_EQ(relaxOnSurface(leaves.Surface(), {}, optionsFor(10)).NonManifoldEdges, 16);
}

// Two squares that cross, with one edge in common: each continues itself.
TEST(SurfaceRelaxation, FourLeaves)
{
  expectEven(makeLeaves(4, 16), 4096);
}

TEST(SurfaceRelaxation, Needles)
{
  expectEven(makeNeedles(500, 4.0), 1024, {}, 2000.0);
}

TEST(SurfaceRelaxation, ManyMoreSamplesThanTriangles)
{
  expectEven(makeBox(1), 20000, {}, 20.0);
}

// Neighbours turn in opposite ways.
TEST(SurfaceRelaxation, AnyOrientation)
{
  Mesh torus = makeTorus(60, 30);
  for (std::size_t i = 0; i < torus.Triangles.size(); i += 3)
  {
    std::swap(torus.Triangles[i][0], torus.Triangles[i][1]);
  }
  expectEven(torus, 4096);
}

TEST(SurfaceRelaxation, Intersections)
{
  Mesh both = makeTorus(60, 30);
  both.Add(both.Mapped([](const Point<3>& x) { return Point<3>{ x[2] + 0.3, x[0], x[1] }; }));
  // Where they cross there is less room.
  expectEven(both, 4096, { 0.88, 0.3, 0.045 });
}

// Two sheets at a fourth of the spacing: all points repel each other.
TEST(SurfaceRelaxation, CrumpledSheets)
{
  Mesh sheets = makeQuads(20, 20, [](double u, double v) { return Point<3>{ u, v, 0.0 }; });
  sheets.Add(sheets.Mapped([](const Point<3>& x) { return Point<3>{ x[0], x[1], 0.005 }; }));
  const Points3 points = relaxed(sheets, optionsFor(4096));
  const auto above =
    std::count_if(points.begin(), points.end(), [](const auto& x) { return x[2] > 0.0; });
  EXPECT_NEAR(static_cast<double>(above), 2048.0, 20.0);
  // In the plane there are twice as many as on a sheet.
  const Spacing spacing = spacingOf(sheets.Surface(), points);
  EXPECT_GT(spacing.Mean, 0.92 * std::sqrt(0.5));
  EXPECT_GT(spacing.Least, 0.7 * std::sqrt(0.5));
}

// Triangles without area, points of no triangle, and some with no sense.
TEST(SurfaceRelaxation, FlatTriangles)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Mesh torus = makeTorus(60, 30);
  const auto last = static_cast<std::int64_t>(torus.Points.size());
  torus.Points.push_back({ nan, 0.0, 0.0 });
  torus.Points.push_back({ 1e300, 0.0, 0.0 });
  // An edge of every tenth triangle is halved on its other side alone: the gap is a flat triangle.
  const std::size_t count = torus.Triangles.size();
  for (std::size_t i = 0; i < count; i += 10)
  {
    const auto [a, b, c] = torus.Triangles[i];
    Point<3> middle;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle[axis] = 0.5 *
        (torus.Points[static_cast<std::size_t>(a)][axis] +
          torus.Points[static_cast<std::size_t>(b)][axis]);
    }
    const auto m = static_cast<std::int64_t>(torus.Points.size());
    torus.Points.push_back(middle);
    torus.Triangles[i] = { a, m, c };
    torus.Triangles.push_back({ m, b, c });
    torus.Triangles.push_back({ a, b, m });
    torus.Triangles.push_back({ a, a, b });
    torus.Triangles.push_back({ c, c, c });
  }
  EXPECT_EQ(relaxOnSurface(torus.Surface(), {}, optionsFor(10)).OpenEdges, 0);
  EXPECT_EQ(torus.Points[static_cast<std::size_t>(last) + 1][0], 1e300);
  expectEven(torus, 4096);
}

// One corner is so far away that all others are one place beside it: walks through flat triangles
// come out over edges of another direction.
TEST(SurfaceRelaxation, FarCorner)
{
  const auto boxTo = [](double height) {
    return makeBox(1).Mapped([height](const Point<3>& x) {
      const bool isFar = x[0] > 0.5 && x[1] < 0.5 && x[2] > 0.5;
      return Point<3>{ x[0], x[1], isFar ? height : x[2] };
    });
  };
  for (const double height : { 1e16, 1e17, 1e20, 1e40, 1e70 })
  {
    relaxed(boxTo(height), optionsFor(100));
  }
  for (const double height : { 1e75, 1e80, 1e100 })
  {
    EXPECT_THROW(relaxOnSurface(boxTo(height).Surface(), {}, optionsFor(1)), std::invalid_argument);
  }
}

// Each part has its share.
TEST(SurfaceRelaxation, Parts)
{
  Mesh parts = makeTorus(60, 30);
  const double torus = areaOf(parts.Surface());
  parts.Add(makeBox(10).Mapped([](const Point<3>& x) {
    return Point<3>{ 0.5 * x[0] + 3.0, 0.5 * x[1], 0.5 * x[2] };
  }));
  const double whole = areaOf(parts.Surface());
  parts.Add(makeBox(4).Mapped([](const Point<3>& x) {
    return Point<3>{ 1e-3 * x[0] + 5.0, 1e-3 * x[1], 1e-3 * x[2] };
  }));
  expectEven(parts, 4096);
  const Points3 points = relaxed(parts, optionsFor(4096));
  const auto onBox = std::count_if(
    points.begin(), points.end(), [](const auto& x) { return x[0] > 2.0 && x[0] < 4.0; });
  EXPECT_NEAR(static_cast<double>(onBox), 4096.0 * (1.0 - torus / whole), 1.5);
}

TEST(SurfaceRelaxation, FewSamples)
{
  const Mesh box = makeBox(4);
  for (const std::int64_t samples : { 0, 1, 2, 3, 10 })
  {
    const Points3 points = relaxed(box, optionsFor(samples));
    if (samples > 1)
    {
      EXPECT_GT(spacingOf(box.Surface(), points).Least, 0.7) << samples;
    }
  }
}

// The mean over some seeds of the number of points within a spacing of a boundary, by their share.
template <class Share, class IsNear>
double boundaryShare(const Mesh& mesh, const Share& share, const IsNear& isNear)
{
  constexpr std::int64_t samples = 4096;
  constexpr int seeds = 6;
  const double spacing = std::sqrt(areaOf(mesh.Surface()) / static_cast<double>(samples));
  double found = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
  {
    for (const Point<3>& x : relaxed(mesh, optionsFor(samples, seed)))
    {
      found += isNear(x, spacing) ? 1.0 : 0.0;
    }
  }
  return found / (seeds * static_cast<double>(samples) * share(spacing));
}

TEST(SurfaceRelaxation, RoundBoundary)
{
  const Mesh hemisphere = makeGlobe(200, 40, 0.5 * pi);
  const double found = boundaryShare(
    hemisphere, [](double spacing) { return spacing; },
    [](const Point<3>& x, double spacing) { return x[2] < spacing; });
  EXPECT_NEAR(found, 1.0, 0.03);
}

TEST(SurfaceRelaxation, SquareBoundary)
{
  const Mesh square = makeQuads(30, 30, [](double u, double v) { return Point<3>{ u, v, 0.0 }; });
  const double found = boundaryShare(
    square, [](double spacing) { return 1.0 - (1.0 - 2.0 * spacing) * (1.0 - 2.0 * spacing); },
    [](const Point<3>& x, double spacing) {
      return std::min({ x[0], 1.0 - x[0], x[1], 1.0 - x[1] }) < spacing;
    });
  EXPECT_NEAR(found, 1.0, 0.03);
}

TEST(SurfaceRelaxation, MoreIterations)
{
  const Mesh torus = makeTorus(60, 30);
  SurfaceRelaxationOptions options = optionsFor(2048);
  double before = 0.0;
  for (const auto& [iterations, least] :
    std::vector<std::pair<int, double>>{ { 0, 0.6 }, { 5, 0.83 }, { 20, 0.9 }, { 60, 0.92 } })
  {
    options.Iterations = iterations;
    const double mean = spacingOf(torus.Surface(), relaxed(torus, options)).Mean;
    EXPECT_GT(mean, std::max(least, before)) << iterations;
    before = mean;
  }
}

// Sizes and places of the surface do not matter, as far as numbers can tell.
TEST(SurfaceRelaxation, AnySize)
{
  const Mesh torus = makeTorus(60, 30);
  for (const double size : { 1e-150, 1e-3, 1e150 })
  {
    const Mesh sized = torus.Mapped([=](const Point<3>& x) {
      return Point<3>{ size * x[0], size * x[1], size * (x[2] + 100.0) };
    });
    const SurfaceRelaxation result = relaxOnSurface(sized.Surface(), {}, optionsFor(1000));
    const Points3 points = positionsOf(torus.Surface(), result.Places);
    EXPECT_GT(spacingOf(torus.Surface(), points).Least, 0.7) << size;
  }
}

// Any triangles of few points: corners that are the same, triangles twice, edges of many.
TEST(SurfaceRelaxation, RandomTriangles)
{
  std::mt19937_64 random(5);
  for (int run = 0; run < 200; ++run)
  {
    Mesh mesh;
    const std::size_t points = 3 + random() % 12;
    for (std::size_t i = 0; i < points; ++i)
    {
      // Coordinates are 0, 1, 2 or 3: many are on one line, or at one place.
      mesh.Points.push_back({ static_cast<double>(random() % 4), static_cast<double>(random() % 4),
        static_cast<double>(random() % (1 + run % 4)) });
    }
    const std::size_t triangles = 1 + random() % 40;
    for (std::size_t i = 0; i < triangles; ++i)
    {
      const auto point = [&]() { return static_cast<std::int64_t>(random() % points); };
      mesh.Triangles.push_back({ point(), point(), point() });
    }
    if (areaOf(mesh.Surface()) > 0.0)
    {
      relaxed(mesh, optionsFor(1 + static_cast<std::int64_t>(random() % 200), random()));
    }
  }
}

} // namespace
} // namespace RectifiedTransport
