// SPDX-License-Identifier: BSD-3-Clause
// Points on surfaces in proportion to densities: steps, slopes, noise and regions without any.
#include "Core/Parallel/Progress.h"
#include "Core/Tables/Density.h"
#include "Surfaces/SurfaceRelaxation/DensityLevels.h"
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include "SurfaceRelaxation/SurfaceMeasures.h"
#include "SurfaceRelaxation/Surfaces.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t samples = 4096;

// The values of triangles by their centres.
template <class Density>
std::vector<double> ofTriangles(const Mesh& mesh, const Density& density)
{
  std::vector<double> values;
  for (std::int64_t t = 0; t < mesh.Surface().NumberOfTriangles; ++t)
  {
    values.push_back(density(positionOf(mesh.Surface(), { t, { 1.0 / 3, 1.0 / 3, 1.0 / 3 } })));
  }
  return values;
}

template <class Density>
std::vector<double> atPoints(const Mesh& mesh, const Density& density)
{
  std::vector<double> values;
  for (const Point<3>& x : mesh.Points)
  {
    values.push_back(density(x));
  }
  return values;
}

SurfaceDensityValues byTriangles(const std::vector<double>& values)
{
  SurfaceDensityValues density;
  density.OfTriangles = values.data();
  return density;
}

SurfaceDensityValues byPoints(const std::vector<double>& values)
{
  SurfaceDensityValues density;
  density.AtPoints = values.data();
  return density;
}

struct Relaxed
{
  SurfaceRelaxation Result;
  Points3 Points;
};

Relaxed run(const Mesh& mesh, const SurfaceDensityValues& density, std::int64_t count = samples)
{
  SurfaceRelaxationOptions options;
  options.NumberOfSamples = count;
  Relaxed run{ relaxOnSurface(mesh.Surface(), density, options), {} };
  EXPECT_EQ(run.Result.Places.size(), count);
  run.Points = positionsOf(mesh.Surface(), run.Result.Places);
  return run;
}

double patchesOf(const Mesh& mesh, const Relaxed& run, const DensityAt& density)
{
  return patchError(
    massPoints(mesh.Surface(), 40.0 * static_cast<double>(samples), density), run.Points);
}

// Relative to the densest lattice of the local density, whose mass is `mass`.
template <class Density>
Spacing spacingAt(const Relaxed& run, double mass, const Density& density)
{
  std::vector<double> densities;
  for (const Point<3>& x : run.Points)
  {
    densities.push_back(density(x) * static_cast<double>(run.Points.size()) / mass);
  }
  return spacingOf(run.Points, densities, [](std::size_t) { return true; });
}

double massOf(const Mesh& mesh, const std::vector<double>& values)
{
  double mass = 0.0;
  for (std::size_t t = 0; t < values.size(); ++t)
  {
    mass += values[t] * areaOf(mesh.Surface(), static_cast<std::int64_t>(t));
  }
  return mass;
}

double step(const Point<3>& x)
{
  return x[0] > 0.0 ? 1.0 : 0.01;
}

// 1:100 between the halves of a torus.
TEST(SurfaceDensities, Step)
{
  const Mesh torus = makeTorus(60, 40);
  const std::vector<double> values = ofTriangles(torus, step);
  const Relaxed found = run(torus, byTriangles(values));
  const DensityAt density = [&](std::int64_t t, const Point<3>&) {
    return values[static_cast<std::size_t>(t)];
  };
  EXPECT_LT(patchesOf(torus, found, density), 0.03);
  double sparse = 0.0;
  for (std::int64_t i = 0; i < samples; ++i)
  {
    const std::int64_t t = found.Result.Places.data()[i].Triangle;
    sparse += values[static_cast<std::size_t>(t)] < 0.5 ? 1.0 : 0.0;
  }
  EXPECT_NEAR(sparse, static_cast<double>(samples) / 101.0, 1.0);
  // Away from the step, both halves are as even as one density.
  const double spacing = std::sqrt(areaOf(torus.Surface()) / 2.0 / static_cast<double>(samples));
  std::vector<double> densities;
  for (const Point<3>& x : found.Points)
  {
    densities.push_back(step(x) * static_cast<double>(samples) / massOf(torus, values));
  }
  const Spacing dense = spacingOf(
    found.Points, densities, [&](std::size_t i) { return found.Points[i][0] > 3.0 * spacing; });
  EXPECT_GT(dense.Mean, 0.9);
  EXPECT_GT(dense.Least, 0.7);
}

double slope(const Point<3>& x)
{
  return std::exp(std::log(100.0) * (x[0] - 1.4) / 2.8);
}

TEST(SurfaceDensities, SlopeOfTriangles)
{
  const Mesh torus = makeTorus(120, 60);
  const std::vector<double> values = ofTriangles(torus, slope);
  const Relaxed found = run(torus, byTriangles(values));
  EXPECT_LT(
    patchesOf(torus, found, [](std::int64_t, const Point<3>& x) { return slope(x); }), 0.03);
  const Spacing spacing = spacingAt(found, massOf(torus, values), slope);
  EXPECT_GT(spacing.Mean, 0.9);
  EXPECT_GT(spacing.Least, 0.7);
}

// Triangles much larger than the spacing: the density is linear in each.
TEST(SurfaceDensities, SlopeAtPoints)
{
  const Mesh square = makeQuads(4, 4, [](double u, double v) { return Point<3>{ u, v, 0.0 }; });
  const auto linear = [](const Point<3>& x) { return 0.2 + x[0]; };
  const std::vector<double> values = atPoints(square, linear);
  const Relaxed found = run(square, byPoints(values));
  EXPECT_LT(
    patchesOf(square, found, [&](std::int64_t, const Point<3>& x) { return linear(x); }), 0.03);
  const Spacing spacing = spacingAt(found, 0.7, linear);
  EXPECT_GT(spacing.Mean, 0.9);
  EXPECT_GT(spacing.Least, 0.65);
}

// A step within one row of small triangles holds, as one of the triangles' values does.
TEST(SurfaceDensities, StepAtPoints)
{
  const Mesh torus = makeTorus(400, 150);
  const std::vector<double> values = atPoints(torus, step);
  const Relaxed found = run(torus, byPoints(values));
  EXPECT_LT(
    patchesOf(torus, found, [](std::int64_t, const Point<3>& x) { return step(x); }), 0.035);
  // What is beyond the row has its share.
  double mass = 0.0;
  double sparse = 0.0;
  for (std::int64_t t = 0; t < torus.Surface().NumberOfTriangles; ++t)
  {
    double mean = 0.0;
    double most = 0.0;
    for (std::int64_t i = 0; i < 3; ++i)
    {
      const auto point = static_cast<std::size_t>(torus.Surface().Triangles[3 * t + i]);
      mean += values[point] / 3.0;
      most = std::max(most, values[point]);
    }
    mass += mean * areaOf(torus.Surface(), t);
    sparse += most < 0.5 ? mean * areaOf(torus.Surface(), t) : 0.0;
  }
  double inSparse = 0.0;
  for (std::int64_t i = 0; i < samples; ++i)
  {
    const std::int64_t* points =
      torus.Surface().Triangles + 3 * found.Result.Places.data()[i].Triangle;
    inSparse += values[static_cast<std::size_t>(points[0])] < 0.5 &&
        values[static_cast<std::size_t>(points[1])] < 0.5 &&
        values[static_cast<std::size_t>(points[2])] < 0.5
      ? 1.0
      : 0.0;
  }
  EXPECT_NEAR(inSparse, sparse / mass * static_cast<double>(samples), 2.0);
}

// 1:100 from triangle to triangle, which are much smaller than the spacing: as even as none.
TEST(SurfaceDensities, FineNoise)
{
  const Mesh torus = makeTorus(300, 150);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit;
  const std::vector<double> values =
    ofTriangles(torus, [&](const Point<3>&) { return std::pow(100.0, unit(random) - 1.0); });
  const Relaxed found = run(torus, byTriangles(values));
  const DensityAt density = [&](std::int64_t t, const Point<3>&) {
    return values[static_cast<std::size_t>(t)];
  };
  EXPECT_LT(patchesOf(torus, found, density), 0.035);
  const Spacing spacing = spacingOf(torus.Surface(), found.Points);
  EXPECT_GT(spacing.Mean, 0.89);
  EXPECT_GT(spacing.Least, 0.65);
}

// Noise within a factor of 2 does not jump, but is as little as the larger one.
TEST(SurfaceDensities, MildNoise)
{
  const Mesh torus = makeTorus(120, 60);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(1.0, 1.9);
  const std::vector<double> values =
    ofTriangles(torus, [&](const Point<3>&) { return part(random); });
  const Spacing spacing = spacingOf(torus.Surface(), run(torus, byTriangles(values)).Points);
  EXPECT_GT(spacing.Mean, 0.9);
  EXPECT_GT(spacing.Least, 0.7);
}

// Triangles as large as the spacing, 1:100, or half of them empty: no point is penned in, where
// patches can tell, and none is in an empty triangle.
TEST(SurfaceDensities, CoarseNoise)
{
  const Mesh torus = makeTorus(90, 45);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit;
  std::vector<double> values =
    ofTriangles(torus, [&](const Point<3>&) { return std::pow(100.0, unit(random) - 1.0); });
  const DensityAt density = [&](std::int64_t t, const Point<3>&) {
    return values[static_cast<std::size_t>(t)];
  };
  const Relaxed found = run(torus, byTriangles(values));
  EXPECT_LT(patchesOf(torus, found, density), 0.06);
  EXPECT_GT(spacingOf(torus.Surface(), found.Points).Mean, 0.8);
  for (double& value : values)
  {
    value = unit(random) < 0.5 ? 0.0 : 1.0;
  }
  const Relaxed half = run(torus, byTriangles(values));
  EXPECT_LT(patchesOf(torus, half, density), 0.05);
  for (std::int64_t i = 0; i < samples; ++i)
  {
    const std::int64_t t = half.Result.Places.data()[i].Triangle;
    ASSERT_GT(values[static_cast<std::size_t>(t)], 0.0);
  }
}

// A checkerboard with jumps of 3. Squares count as noise if they have the mass of few dots, even
// where they are as wide as the spacing.
TEST(SurfaceDensities, SquaresOfFewDots)
{
  constexpr std::int64_t quads = 32;
  constexpr double squares = 8.0;
  const Mesh box = makeBox(quads);
  const std::vector<double> values = ofTriangles(box, [](const Point<3>& x) {
    int sum = 0;
    for (const double coordinate : x)
    {
      sum += static_cast<int>(std::floor(squares * (coordinate + 1e-9)));
    }
    return sum % 2 == 0 ? 1.0 : 3.0;
  });
  for (const double dots : { 5.0, 20.0 }) // in a sparse square
  {
    Progress progress{ Context() };
    GeodesicTracer surface(box.Surface(), 0.0, progress);
    const SurfaceDensity density(surface, byTriangles(values), progress);
    double square = 0.0; // its mass
    for (std::int64_t t = 0; t < surface.NumberOfTriangles(); ++t)
    {
      square += surface.Area(t) / (6.0 * squares * squares * 3.0);
    }
    const DensityLevels levels(surface, density, square / dots, progress);
    int sparse = 0;
    int noisy = 0;
    for (std::int64_t t = 0; t < surface.NumberOfTriangles(); ++t)
    {
      const bool isSparse = values[static_cast<std::size_t>(t)] == 1.0;
      sparse += isSparse ? 1 : 0;
      noisy += isSparse && levels.data()[t] > 0.0 ? 1 : 0;
    }
    // At the edges of the box squares of one density may meet.
    EXPECT_GE(noisy, dots < 8.0 ? sparse / 2 : 0);
    EXPECT_LE(noisy, dots < 8.0 ? sparse : 0);
  }
}

// Half of the surface is empty: its border is a boundary.
TEST(SurfaceDensities, Empty)
{
  const Mesh square = makeQuads(40, 40, [](double u, double v) { return Point<3>{ u, v, 0.0 }; });
  const std::vector<double> values =
    ofTriangles(square, [](const Point<3>& x) { return x[0] < 0.5 ? 3.0 : 0.0; });
  const Relaxed found = run(square, byTriangles(values));
  double near = 0.0;
  const double width = std::sqrt(0.5 / static_cast<double>(samples));
  for (const Point<3>& x : found.Points)
  {
    ASSERT_LE(x[0], 0.5 + 1e-15);
    near += x[0] > 0.5 - width ? 1.0 : 0.0;
  }
  EXPECT_NEAR(near / (static_cast<double>(samples) * 2.0 * width), 1.0, 0.08);
  const Spacing spacing = spacingOf(found.Points,
    std::vector<double>(found.Points.size(), 2.0 * static_cast<double>(samples)),
    [](std::size_t) { return true; });
  EXPECT_GT(spacing.Mean, 0.9);
  EXPECT_GT(spacing.Least, 0.7);
  // The same by values at points, of which the row at the border is half full.
  const std::vector<double> points =
    atPoints(square, [](const Point<3>& x) { return x[0] < 0.49 ? 3.0 : 0.0; });
  for (const Point<3>& x : run(square, byPoints(points)).Points)
  {
    ASSERT_LE(x[0], 0.5 + 1e-15);
  }
}

// Mass on one of two parts alone.
TEST(SurfaceDensities, OnePart)
{
  Mesh two = makeTorus(40, 20);
  two.Add(two.Mapped([](const Point<3>& x) { return Point<3>{ x[0], x[1], x[2] + 0.1 }; }));
  std::vector<double> values(two.Triangles.size(), 0.0);
  std::fill(values.begin(), values.begin() + 1600, 5.0);
  const Relaxed found = run(two, byTriangles(values), 1000);
  for (std::int64_t i = 0; i < 1000; ++i)
  {
    ASSERT_LT(found.Result.Places.data()[i].Triangle, 1600);
  }
}

// A seam where the density jumps back to what it begins with, on a surface that is one part.
TEST(SurfaceDensities, Seam)
{
  const Mesh torus = makeTorus(120, 60);
  const auto turn = [](const Point<3>& x) {
    const double angle = std::atan2(x[1], x[0]);
    return std::exp(std::log(100.0) * angle / (2.0 * pi));
  };
  const std::vector<double> values = ofTriangles(torus, turn);
  const Relaxed found = run(torus, byTriangles(values));
  EXPECT_LT(
    patchesOf(torus, found, [&](std::int64_t, const Point<3>& x) { return turn(x); }), 0.03);
}

// Densities count by their ratios.
TEST(SurfaceDensities, AnyScale)
{
  const Mesh torus = makeTorus(40, 20);
  std::vector<double> values = ofTriangles(torus, slope);
  const Relaxed one = run(torus, byTriangles(values), 500);
  for (const double scale : { 0x1p-1000, 0x1p1000 })
  {
    std::vector<double> scaled = values;
    for (double& value : scaled)
    {
      value *= scale;
    }
    EXPECT_EQ(run(torus, byTriangles(scaled), 500).Points, one.Points);
  }
}

template <class F>
std::string invalid(const F& call)
{
  try
  {
    call();
  }
  catch (const InvalidDensity& error)
  {
    return error.what();
  }
  ADD_FAILURE() << "the density was accepted";
  return "";
}

TEST(SurfaceDensities, Errors)
{
  const Mesh torus = makeTorus(10, 10);
  std::vector<double> values(200, 1.0);
  values[7] = -1.0;
  values[9] = -2.0;
  EXPECT_EQ(invalid([&]() { run(torus, byTriangles(values)); }),
    "the density has 2 negative values, the first at index 7");
  values[8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(invalid([&]() { run(torus, byTriangles(values)); }),
    "the density has 1 values that are not finite, the first at index 8");
  const std::vector<double> none(200, 0.0);
  EXPECT_EQ(invalid([&]() { run(torus, byTriangles(none)); }), "the density's total is zero");
  EXPECT_EQ(invalid([&]() { run(torus, byPoints(none)); }), "the density's total is zero");
}

} // namespace
} // namespace RectifiedTransport
