// SPDX-License-Identifier: BSD-3-Clause
// Points of a surface that follow masses: against the flow of an image where the surface is flat,
// and by counts where it is not.
#include "../../SeedPatterns.h"
#include "Surfaces/SurfaceSampling/SamplePatches.h"
#include "Surfaces/SurfaceSampling/SurfaceSamples.h"

#include "TestFlow.h"
#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace RectifiedTransport
{
namespace
{

// A grid of quads, two triangles each, on a surface that `place(x, y)` lifts from a rectangle.
struct QuadSurface
{
  GridSize<2> Quads;
  Points<3> Places;
  std::vector<std::array<std::int64_t, 3>> Triangles;

  template <class Place>
  QuadSurface(const GridSize<2>& quads, const Place& place)
    : Quads(quads)
  {
    const std::int64_t row = quads[0] + 1;
    for (std::int64_t j = 0; j <= quads[1]; ++j)
    {
      for (std::int64_t i = 0; i <= quads[0]; ++i)
      {
        this->Places.push_back(place(static_cast<double>(i), static_cast<double>(j)));
        if (i < quads[0] && j < quads[1])
        {
          const std::int64_t p = j * row + i;
          this->Triangles.push_back({ p, p + 1, p + row + 1 });
          this->Triangles.push_back({ p, p + row + 1, p + row });
        }
      }
    }
  }

  DiskMesh Disk() const
  {
    return DiskMesh({ this->Places, this->Triangles[0].data(),
      static_cast<std::int64_t>(this->Triangles.size()) });
  }
  ConformalMap Map(const DiskMesh& disk) const
  {
    const std::int64_t right = this->Quads[0];
    const std::int64_t last = static_cast<std::int64_t>(this->Places.size()) - 1;
    return mapConformally(disk, orderCorners(disk, { 0, right, last, last - right }));
  }
};

// A rectangle in an oblique plane.
Point<3> inPlane(double x, double y)
{
  return { 3.0 + 0.6 * x, -1.0 + y, 0.8 * x };
}

Point<3> onHill(double x, double y)
{
  const double r = ((x - 32.0) * (x - 32.0) + (y - 32.0) * (y - 32.0)) / 400.0;
  return { x, y, 20.0 * std::exp(-r) };
}

Point<3> positionOf(const QuadSurface& surface, const PlaceOnTriangle& place)
{
  const auto& triangle = surface.Triangles[static_cast<std::size_t>(place.Triangle)];
  Point<3> x{ 0.0, 0.0, 0.0 };
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    const Point<3>& point = surface.Places[static_cast<std::size_t>(triangle[corner])];
    for (std::size_t r = 0; r < 3; ++r)
    {
      x[r] += place.Weights[corner] * point[r];
    }
  }
  return x;
}

std::vector<PlaceOnTriangle> placesOf(const SurfaceSamples& samples)
{
  const PlaceOnTriangle* places = samples.Places.data();
  return { places, places + samples.Places.size() };
}

// With quads as the cells of an image, the samples are those of the image's density.
TEST(SurfaceSamples, RectangleAsImage)
{
  const QuadSurface surface({ 48, 16 }, inPlane);
  const DiskMesh disk = surface.Disk();
  const ConformalMap map = surface.Map(disk);
  EXPECT_NEAR(map.AspectRatio, 3.0, 1e-10);
  EXPECT_EQ(flatGrid(map.AspectRatio, 48), surface.Quads);
  const GridSize<2> tall{ 16, 48 };
  EXPECT_EQ(flatGrid(1.0 / 3.0, 48), tall);
  const std::vector<double> density = randomCells<2>(surface.Quads, 0.1).Values;
  std::vector<double> masses;
  for (const double value : density)
  {
    masses.insert(masses.end(), 2, 0.5 * value);
  }
  SurfaceSamplingOptions options;
  options.NumberOfSamples = 1500;
  options.Resolution = 48;
  options.Flow.NumberOfSteps = 24;
  for (const SeedPattern pattern : seedPatterns)
  {
    options.Pattern = pattern;
    const std::vector<PlaceOnTriangle> places =
      placesOf(sampleSurface(disk, map, masses.data(), options));
    const UnitSeeds<2> unit(pattern, { 1.0, 1.0 / 3.0 }, 1500, 1);
    Points<2> seeds(static_cast<std::size_t>(unit.Count()));
    unit.Generate(seeds);
    ASSERT_EQ(places.size(), seeds.size());
    for (Point<2>& seed : seeds)
    {
      seed = { 48.0 * seed[0], 16.0 * seed[1] };
    }
    const Points<2> expected = transportPoints<2>(
      DensityArray<2, double>(density.data(), surface.Quads), seeds, options.Flow);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const Point<3> x = positionOf(surface, places[i]);
      const Point<3> y = inPlane(expected[i][0], expected[i][1]);
      for (std::size_t r = 0; r < 3; ++r)
      {
        ASSERT_NEAR(x[r], y[r], 1e-7) << i;
      }
    }
  }
}

// Patches of 8 x 8 quads of a hill hold samples in proportion to their mass.
void expectInProportion(const std::vector<double>& density, double tolerance)
{
  const QuadSurface surface({ 64, 64 }, onHill);
  const DiskMesh disk = surface.Disk();
  std::vector<double> masses(surface.Triangles.size());
  for (std::size_t t = 0; t < masses.size(); ++t)
  {
    masses[t] = disk.AreaShare(static_cast<std::int64_t>(t)) * density[t];
  }
  SurfaceSamplingOptions options;
  options.NumberOfSamples = 4096;
  options.Resolution = 512;
  const SurfaceSamples samples = sampleSurface(disk, surface.Map(disk), masses.data(), options);
  EXPECT_EQ(samples.Places.size(), 4096);
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  std::vector<double> expected(64, 0.0);
  std::vector<double> found(64, 0.0);
  const auto patchOf = [](std::size_t triangle) {
    const std::size_t quad = triangle / 2;
    return quad / 64 / 8 * 8 + quad % 64 / 8;
  };
  for (std::size_t t = 0; t < masses.size(); ++t)
  {
    expected[patchOf(t)] += 4096.0 * masses[t] / total;
  }
  for (const PlaceOnTriangle& place : placesOf(samples))
  {
    const auto triangle = static_cast<std::size_t>(place.Triangle);
    ASSERT_GT(masses[triangle], 0.0);
    ASSERT_GE(*std::min_element(place.Weights.begin(), place.Weights.end()), 0.0);
    found[patchOf(triangle)] += 1.0;
  }
  double squares = 0.0;
  double all = 0.0;
  for (std::size_t patch = 0; patch < 64; ++patch)
  {
    squares += std::pow(found[patch] - expected[patch], 2.0);
    all += std::pow(expected[patch], 2.0);
  }
  EXPECT_LT(std::sqrt(squares / all), tolerance);
}

TEST(SurfaceSamples, AreaOfAHill)
{
  expectInProportion(std::vector<double>(2 * 64 * 64, 1.0), 0.04);
}

TEST(SurfaceSamples, DensityOnAHill)
{
  std::vector<double> density(2 * 64 * 64);
  for (std::size_t t = 0; t < density.size(); ++t)
  {
    density[t] = 1.0 + 9.0 * static_cast<double>(t / 2 % 64) / 64.0;
  }
  expectInProportion(density, 0.05);
}

// Bands without mass stay empty.
TEST(SurfaceSamples, BandsOnAHill)
{
  std::vector<double> density(2 * 64 * 64);
  for (std::size_t t = 0; t < density.size(); ++t)
  {
    density[t] = t / 2 % 64 % 3 == 0 ? 1.0 : 0.0;
  }
  expectInProportion(density, 0.05);
}

// All mass in one triangle.
TEST(SurfaceSamples, OneTriangle)
{
  const QuadSurface surface({ 64, 64 }, onHill);
  const DiskMesh disk = surface.Disk();
  std::vector<double> masses(surface.Triangles.size(), 0.0);
  masses[4321] = 1e-300;
  SurfaceSamplingOptions options;
  options.NumberOfSamples = 100;
  for (const PlaceOnTriangle& place :
    placesOf(sampleSurface(disk, surface.Map(disk), masses.data(), options)))
  {
    ASSERT_EQ(place.Triangle, 4321);
  }
}

TEST(SurfaceSamples, Refusals)
{
  const QuadSurface surface({ 4, 4 }, inPlane);
  const DiskMesh disk = surface.Disk();
  const ConformalMap map = surface.Map(disk);
  SurfaceSamplingOptions options;
  for (const std::int64_t resolution : { 0, 16385 })
  {
    options.Resolution = resolution;
    EXPECT_EQ(refusal([&]() { sampleSurface(disk, map, disk.AreaShares(), options); }),
      "the resolution is " + std::to_string(resolution) + "; it must be from 1 to 16384");
  }
  options.Resolution = 1;
  options.NumberOfSamples = 3;
  EXPECT_EQ(sampleSurface(disk, map, disk.AreaShares(), options).Places.size(), 3);
  options.NumberOfSamples = -1;
  EXPECT_EQ(refusal([&]() { sampleSurface(disk, map, disk.AreaShares(), options); }),
    "the number of samples is -1; it must be at least 0");
  options.NumberOfSamples = 10;
  const std::vector<double> none(surface.Triangles.size(), 0.0);
  EXPECT_THROW(sampleSurface(disk, map, none.data(), options), InvalidDensity);
}

TEST(SurfaceSamples, ThreadsProgressAndCancel)
{
  const QuadSurface surface({ 64, 64 }, onHill);
  const DiskMesh disk = surface.Disk();
  const ConformalMap map = surface.Map(disk);
  SurfaceSamplingOptions options;
  options.NumberOfSamples = 20000;
  const auto run = [&](const Context& context) {
    return placesOf(sampleSurface(disk, map, disk.AreaShares(), options, context));
  };
  const SerialExecutor serial;
  const OpenMPExecutor threads;
  const std::vector<PlaceOnTriangle> expected = run(serial);
  const std::vector<PlaceOnTriangle> found = run(threads);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    ASSERT_EQ(expected[i].Triangle, found[i].Triangle);
    ASSERT_EQ(expected[i].Weights, found[i].Weights);
  }
  double last = 0.0;
  int reports = 0;
  run({ serial, [&](double progress) {
         EXPECT_GE(progress, last);
         last = progress;
         ++reports;
       } });
  EXPECT_EQ(last, 1.0);
  EXPECT_GT(reports, 5);
  for (const double from : { 0.0, 0.1, 0.3, 0.6, 0.8, 0.9 })
  {
    double reached = 0.0;
    const Context context(
      serial, [&](double progress) { reached = progress; }, [&]() { return reached >= from; });
    EXPECT_THROW(run(context), Cancelled) << from;
  }
}

// A tube of radius 1 and height `height`, closed at its upper end.
QuadSurface makeTube(double height)
{
  constexpr std::int64_t around = 48;
  const auto along = static_cast<std::int64_t>(height * around / 6.28);
  QuadSurface tube({ around, along }, [=](double i, double j) {
    const double angle = 2.0 * std::acos(-1.0) * i / around;
    return Point<3>{ std::cos(angle), std::sin(angle), height * j / static_cast<double>(along) };
  });
  // The last column of points is the first again, and a fan closes the end.
  for (auto& triangle : tube.Triangles)
  {
    for (std::int64_t& point : triangle)
    {
      point = point % (around + 1) == around ? point - around : point;
    }
  }
  const std::int64_t end = along * (around + 1);
  for (std::int64_t i = 0; i < around; ++i)
  {
    tube.Triangles.push_back({ end + i, end + (i + 1) % around, end + around });
  }
  tube.Places.back() = { 0.0, 0.0, height }; // a duplicate until now: the middle of the end
  // Points of the other rows' last column are used no more: they move to the end of the list.
  std::vector<std::int64_t> numbers(tube.Places.size(), -1);
  Points<3> used;
  for (auto& triangle : tube.Triangles)
  {
    for (std::int64_t& point : triangle)
    {
      std::int64_t& number = numbers[static_cast<std::size_t>(point)];
      if (number < 0)
      {
        number = static_cast<std::int64_t>(used.size());
        used.push_back(tube.Places[static_cast<std::size_t>(point)]);
      }
      point = number;
    }
  }
  tube.Places = used;
  return tube;
}

// The conformal map squeezes the far end of a long tube into a cell of the grid.
TEST(SurfaceSamples, LongTubes)
{
  for (const double height : { 2.0, 10.0 })
  {
    const QuadSurface tube = makeTube(height);
    const DiskMesh disk = tube.Disk();
    const ConformalMap map = mapConformally(disk, chooseCorners(disk));
    SurfaceSamplingOptions options;
    options.NumberOfSamples = 4096;
    options.Resolution = 256;
    const SurfaceSamples samples = sampleSurface(disk, map, disk.AreaShares(), options);
    EXPECT_EQ(samples.IsAreaPreserving, height > 5.0);
    EXPECT_LT(samples.PatchError, 0.1);
    EXPECT_EQ(samples.PatchError, patchError(disk, disk.AreaShares(), samples.Places));
    constexpr std::size_t bands = 8;
    std::array<double, bands> counts{};
    double onTube = 0.0;
    for (std::int64_t i = 0; i < samples.Places.size(); ++i)
    {
      const PlaceOnTriangle& place = samples.Places.data()[i];
      double z = 0.0;
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        const auto point = static_cast<std::size_t>(disk.Triangle(place.Triangle)[corner]);
        z += place.Weights[corner] * tube.Places[point][2];
      }
      if (z < height - 1e-9) // not in the end
      {
        counts[static_cast<std::size_t>(bands * z / height)] += 1.0;
        onTube += 1.0;
      }
    }
    for (const double count : counts)
    {
      EXPECT_NEAR(count, onTube / bands, 0.1 * onTube / bands) << height;
    }
  }
}

// All samples in the first triangle of a flat grid; and as many in each as its mass.
TEST(PatchError, CountsBySharesOfTheMass)
{
  const QuadSurface flat({ 8, 8 }, [](double x, double y) { return Point<3>{ x, y, 0.0 }; });
  const DiskMesh disk = flat.Disk();
  constexpr std::int64_t count = 128 * 64; // a patch a triangle
  LargeBuffer<PlaceOnTriangle> places(count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    places.data()[i] = { i % 128, { 1.0, 0.0, 0.0 } };
  }
  EXPECT_NEAR(patchError(disk, disk.AreaShares(), places), 0.0, 1e-12);
  for (std::int64_t i = 0; i < count; ++i)
  {
    places.data()[i].Triangle = 0;
  }
  // 127 patches lack 1/128 and one has 127/128 too much: sqrt((127 + 127^2) / 128) = sqrt(127).
  EXPECT_NEAR(patchError(disk, disk.AreaShares(), places), std::sqrt(127.0), 1e-9);
  EXPECT_EQ(patchError(disk, disk.AreaShares(), LargeBuffer<PlaceOnTriangle>(0)), 0.0);
}

} // namespace
} // namespace RectifiedTransport
