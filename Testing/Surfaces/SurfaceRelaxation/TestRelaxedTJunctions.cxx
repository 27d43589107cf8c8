// SPDX-License-Identifier: BSD-3-Clause
// Points spread over surfaces with T-junctions: as evenly there as elsewhere.
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include "HangingNodes.h"
#include "SurfaceRelaxation/SurfaceMeasures.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t samples = 4096;

SurfaceRelaxationOptions optionsFor(double rounding = 0.0)
{
  SurfaceRelaxationOptions options;
  options.NumberOfSamples = samples;
  options.Rounding = rounding;
  return options;
}

// Places are on the given triangles.
Points3 expectEven(const Mesh& mesh, std::int64_t junctions, double rounding = 0.0)
{
  const SurfaceRelaxation result = relaxOnSurface(mesh.Surface(), {}, optionsFor(rounding));
  EXPECT_EQ(result.TJunctions, junctions);
  EXPECT_EQ(result.OpenEdges, 0);
  Points3 points;
  for (std::int64_t i = 0; i < samples; ++i)
  {
    const PlaceOnTriangle& place = result.Places.data()[i];
    EXPECT_LT(place.Triangle, mesh.Surface().NumberOfTriangles);
    EXPECT_NEAR(place.Weights[0] + place.Weights[1] + place.Weights[2], 1.0, 1e-14);
    EXPECT_GE(*std::min_element(place.Weights.begin(), place.Weights.end()), 0.0);
    points.push_back(positionOf(mesh.Surface(), place));
  }
  const Spacing spacing = spacingOf(mesh.Surface(), points);
  EXPECT_GT(spacing.Mean, 0.9);
  EXPECT_GT(spacing.Least, 0.7);
  EXPECT_LT(patchError(massPoints(mesh.Surface(), 40.0 * samples), points), 0.03);
  return points;
}

TEST(RelaxedTJunctions, Box)
{
  for (const std::int64_t ratio : { 2, 4 })
  {
    expectEven(makeRefinedBox(4, ratio), 16 * (ratio - 1));
  }
}

// The mean over some seeds of the number of points within a spacing of the equator, by their share.
double shareAtEquator(const Mesh& globe)
{
  const double spacing = std::sqrt(4.0 * pi / samples);
  double found = 0.0;
  constexpr int seeds = 6;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    SurfaceRelaxationOptions options = optionsFor();
    options.RandomSeed = static_cast<std::uint64_t>(seed);
    const SurfaceRelaxation result = relaxOnSurface(globe.Surface(), {}, options);
    for (const Point<3>& x : positionsOf(globe.Surface(), result.Places))
    {
      found += std::abs(x[2]) < spacing ? 1.0 : 0.0;
    }
  }
  return found / (seeds * spacing * samples);
}

// As many at the equator as without T-junctions there.
TEST(RelaxedTJunctions, Globe)
{
  const double expected = shareAtEquator(makeRefinedGlobe(60, 15, 1));
  for (const std::int64_t ratio : { 2, 4 })
  {
    const Mesh globe = makeRefinedGlobe(60, 15, ratio);
    expectEven(globe, 60 * (ratio - 1));
    EXPECT_NEAR(shareAtEquator(globe), expected, 0.04) << ratio;
  }
}

// Coordinates that are rounded to 1/16 of a metre.
TEST(RelaxedTJunctions, FarAwayInFloat)
{
  const double size = 4000.0;
  const Mesh far = farAwayInFloat(makeRefinedBox(4, 2).Mapped([=](const Point<3>& x) {
    return Point<3>{ size * x[0], size * x[1], size * x[2] };
  }),
    500000.0);
  expectEven(far, 16, 4.0 * std::numeric_limits<float>::epsilon() * 500000.0);
}

TEST(RelaxedTJunctions, SlitsStay)
{
  Mesh slit = makeZigzag({ 0.2, 0.4, 0.7 }, { 0.3, 0.6, 0.8 });
  EXPECT_EQ(relaxOnSurface(slit.Surface(), {}, optionsFor()).TJunctions, 6);
  for (std::size_t i = 10; i < slit.Points.size(); i += 2)
  {
    slit.Points[i][1] += 1e-5;
  }
  EXPECT_EQ(relaxOnSurface(slit.Surface(), {}, optionsFor()).TJunctions, 0);
}

// Each triangle has the density of its own corners, whatever that is at points on its sides.
TEST(RelaxedTJunctions, Densities)
{
  const Mesh box = makeRefinedBox(2, 4);
  std::vector<double> atPoints;
  for (const Point<3>& x : box.Points)
  {
    const bool isHanging = x[2] == 1.0 &&
      std::any_of(x.begin(), x.end(), [](double at) { return 2.0 * at != std::floor(2.0 * at); });
    atPoints.push_back(isHanging ? 3.0 : 1.0);
  }
  SurfaceDensityValues linear;
  linear.AtPoints = atPoints.data();
  std::vector<double> masses;
  double total = 0.0;
  for (std::int64_t t = 0; t < box.Surface().NumberOfTriangles; ++t)
  {
    double sum = 0.0;
    for (const std::int64_t point : box.Triangles[static_cast<std::size_t>(t)])
    {
      sum += atPoints[static_cast<std::size_t>(point)];
    }
    masses.push_back(areaOf(box.Surface(), t) * sum / 3.0);
    total += masses.back();
  }
  std::vector<double> ofTriangles;
  for (std::size_t t = 0; t < masses.size(); ++t)
  {
    ofTriangles.push_back(masses[t] / areaOf(box.Surface(), static_cast<std::int64_t>(t)));
  }
  SurfaceDensityValues constant;
  constant.OfTriangles = ofTriangles.data();
  // The top has about half of the mass; its triangles are the last ones.
  const std::size_t top = box.Triangles.size() - 2 * 8 * 8;
  double expected = 0.0;
  for (std::size_t t = top; t < masses.size(); ++t)
  {
    expected += samples * masses[t] / total;
  }
  for (const SurfaceDensityValues& density : { linear, constant })
  {
    SurfaceRelaxationOptions options = optionsFor();
    options.Iterations = 0; // later, some walk over the edge
    const SurfaceRelaxation result = relaxOnSurface(box.Surface(), density, options);
    EXPECT_EQ(result.TJunctions, 4 * 2 * 3);
    double found = 0.0;
    for (std::int64_t i = 0; i < samples; ++i)
    {
      found += result.Places.data()[i].Triangle >= static_cast<std::int64_t>(top) ? 1.0 : 0.0;
    }
    EXPECT_NEAR(found, expected, 10.0) << result.TJunctions;
  }
}

TEST(RelaxedTJunctions, AnyThreads)
{
  const Mesh globe = makeRefinedGlobe(30, 8, 2);
  const SurfaceRelaxation one = relaxOnSurface(globe.Surface(), {}, optionsFor());
  for (const int threads : { 2, 3 })
  {
    const ThreadsExecutor executor(threads);
    Context context;
    context.Threads = &executor;
    const SurfaceRelaxation other = relaxOnSurface(globe.Surface(), {}, optionsFor(), context);
    EXPECT_EQ(std::memcmp(one.Places.data(), other.Places.data(),
                static_cast<std::size_t>(one.Places.bytes())),
      0);
  }
}

} // namespace
} // namespace RectifiedTransport
