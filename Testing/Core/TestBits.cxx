// SPDX-License-Identifier: BSD-3-Clause
// The bits of what Core computes.
#include "../SeedPatterns.h"
#include "AreaErrors.h"
#include "Core/Equalize/EqualizeAreas.h"
#include "Core/Flow/MapDerivatives.h"
#include "Core/Quality/NearestNeighbours.h"
#include "Core/Seeds/Seeds.h"
#include "Core/SiteCells/EqualMasses/EqualizeSiteCells.h"
#include "Core/SiteCells/EqualMasses/SplitSharedPixels.h"
#include "TestDigest.h"
#include "TestDimensions.h"
#include "TestFlow.h"
#include "TestSplat.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

void expectDigest(const std::string& what, const Digest& digest)
{
  static const KnownDigests known = {
    { "1D Multistep", 0x73d4185f7853e6fau },
    { "1D RungeKutta4", 0x29b787eb195f4102u },
    { "1D Euler", 0x24d0d16e57951994u },
    { "1D Adaptive", 0x4472fd3390f8d38fu },
    { "1D equalized", 0x41a3de7c45b34bcfu },
    { "1D lattice", 0x299c0c804432b57eu },
    { "2D Multistep", 0xbabdbc16eb47b46eu },
    { "2D RungeKutta4", 0x54c8c44d583eb003u },
    { "2D Euler", 0xe9d12fe1b7fc73b1u },
    { "2D Adaptive", 0x439f2ed3f211c1c9u },
    { "2D equalized", 0x65a2da5087f0cb33u },
    { "2D lattice", 0xea9f823ee013817u },
    { "3D Multistep", 0x2ac4b3726f29677u },
    { "2D maps", 0x4002fd163e0995beu },
    { "3D maps", 0x6a9d225bc49557c5u },
    { "3D RungeKutta4", 0xf6297220318b606du },
    { "3D Euler", 0x2770eb9ea33e134du },
    { "3D Adaptive", 0x19618df03942d44bu },
    { "3D equalized", 0x1c72c60a50be483au },
    { "3D lattice", 0xfce828c9f60676afu },
    { "seeds 0", 0xe0002fd2e6c93e45u },
    { "seeds 2", 0x6a2ae7ea9cf04cbdu },
    { "seeds 3", 0xff610da7df8f9d6bu },
    { "seeds 4", 0xb95ce7f46a72569u },
    { "cells", 0xa93428379b788350u },
    { "splat 0", 0x6bab6d9ec114aa2u },
    { "splat 1", 0xb044657a91783cd5u },
    { "splat 2", 0x9445002a37b3e017u },
    { "splat 3", 0xde6e3006ec464fb8u },
    { "neighbours", 0xdcdd9212c32fb8b8u },
  };
  expectDigest(known, what, digest);
}

// Inputs are made of the engine's bits alone, without arithmetic that a compiler may do otherwise.
template <int Dimension>
TestDensity<Dimension> patchyCells(const GridSize<Dimension>& size)
{
  TestDensity<Dimension> density = randomCells<Dimension>(size);
  for (double& value : density.Values)
  {
    value = value < 0.25 ? 0.0 : value;
  }
  return density;
}

template <int Dimension>
void expectFlow(const GridSize<Dimension>& size)
{
  const std::string name = std::to_string(Dimension) + "D ";
  const RectifiedFlow<Dimension> flow = makeFlow(patchyCells<Dimension>(size));
  constexpr std::size_t count = 500;
  const Points<Dimension> seeds = randomPoints<Dimension>(size, count);
  const auto valuesOf = [](const Points<Dimension>& points) {
    return std::vector<double>(
      points.data()->data(), points.data()->data() + points.size() * Dimension);
  };
  for (const Integrator method : AllIntegrators)
  {
    FlowOptions options = steps(20, method);
    Digest digest;
    for (const TableLookup lookup : { TableLookup::Interpolated, TableLookup::Nearest })
    {
      options.Lookup = lookup;
      digest.Add(valuesOf(runForward(flow, seeds, options)));
      digest.Add(valuesOf(runBackward(flow, seeds, options)));
    }
    Points<Dimension> paths(3 * count);
    options.Lookup = TableLookup::Interpolated;
    flow.ForwardAt(seeds, { 0.25, 0.75, 1.0 }, paths, options);
    digest.Add(valuesOf(paths));
    expectDigest(name + nameOf(method), digest);
  }

  if constexpr (Dimension > 1)
  {
    const RectifiedFlow<Dimension> large =
      makeFlow(patchyCells<Dimension>(sizeFor<Dimension>({}, { 190, 137 }, { 80, 90, 71 })));
    const FlowOptions options = with(FlowMaps::On, steps(20));
    Points<Dimension> places = randomPoints<Dimension>(large.Size(), count);
    Digest digest;
    digest.Add(valuesOf(runForward(large, places, options)));
    digest.Add(valuesOf(runBackward(large, places, options)));
    const auto samples = sizeFor<Dimension>({}, { 64, 32 }, { 13, 15, 7 });
    places.resize(static_cast<std::size_t>(cellCount<Dimension>(samples)));
    large.Forward(FlowSeeds<Dimension>::Lattice(samples), places, options);
    digest.Add(valuesOf(places));
    expectDigest(name + "maps", digest);
  }

  const TestDensity<Dimension> density = patchyCells<Dimension>(size);
  Points<Dimension> corners = cornerLattice<Dimension>(size);
  const Points<Dimension> offsets = randomPoints<Dimension>(evenSize<Dimension>(1), corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto side = static_cast<double>(size[axis]);
      const bool isOnSide = corners[i][axis] == 0.0 || corners[i][axis] == side;
      corners[i][axis] += isOnSide ? 0.0 : 0.25 * (offsets[i][axis] - 0.5);
    }
  }
  equalizeAreas<Dimension>(
    DensityArray<Dimension, double>(density.Values.data(), size), size, flow.Total(), corners);
  Digest equalized;
  equalized.Add(valuesOf(corners));
  expectDigest(name + "equalized", equalized);

  const auto lattice = evenSize<Dimension>(Dimension == 1 ? 700 : Dimension == 2 ? 24 : 9);
  Points<Dimension> positions(static_cast<std::size_t>(cellCount<Dimension>(lattice)));
  std::vector<std::int64_t> cells(positions.size());
  flow.Forward(FlowSeeds<Dimension>::Lattice(lattice), positions);
  flow.ForwardToCells(FlowSeeds<Dimension>::Lattice(lattice), cells.data());
  std::vector<double> divergence(cells.size());
  std::vector<double> determinant(cells.size());
  MapDerivatives<Dimension>(lattice, evenPoint<Dimension>(0.5), positions)
    .Write(0, cellCount<Dimension>(lattice), divergence.data(), determinant.data());
  const Point<Dimension> centroid = flow.Centroid();
  Digest digest;
  digest.Add(valuesOf(positions));
  digest.Add(cells);
  digest.Add(divergence);
  digest.Add(determinant);
  digest.Add(std::vector<double>{ flow.Total(), flow.Share(seeds[0], seeds[1]) });
  digest.Add(std::vector<double>(centroid.begin(), centroid.end()));
  expectDigest(name + "lattice", digest);
}

// With coarse levels of the tables in each dimension.
TEST(Bits, Flow)
{
  expectFlow<1>({ 700 });
  expectFlow<2>({ 150, 131 });
  expectFlow<3>({ 130, 133, 129 });
}

TEST(Bits, Seeds)
{
  for (const SeedPattern pattern : scatteredPatterns)
  {
    constexpr std::int64_t count = 1500;
    Digest digest;
    std::vector<double> points(3 * count);
    generateSeeds<1>(pattern, { 2.0 }, 5, { points.data(), count });
    digest.Add(points);
    generateSeeds<2>(pattern, { 2.0, 3.0 }, 5, { points.data(), count });
    digest.Add(points);
    generateSeeds<3>(pattern, { 2.0, 3.0, 1.0 }, 5, { points.data(), count });
    digest.Add(points);
    expectDigest("seeds " + std::to_string(static_cast<int>(pattern)), digest);
  }
}

template <int Dimension>
void addCells(const GridSize<Dimension>& size, Digest& digest)
{
  Points<Dimension> places = randomPoints<Dimension>(size, 30, 3);
  places.push_back(places[4]);
  const SiteDensity<Dimension> sites(size, places);
  auto spacing = evenPoint<Dimension>(1.0);
  spacing[0] = 1.25;
  std::vector<std::int64_t> labels(static_cast<std::size_t>(cellCount<Dimension>(size)));
  const RectifiedFlow<Dimension> flow(sites);
  flow.ForwardToCells(FlowSeeds<Dimension>::Lattice(size), labels.data());
  for (std::int64_t& label : labels)
  {
    label = sites.Find(label);
  }
  digest.Add(labels);
  equalizeSiteCells<Dimension>(sites, spacing, labels.data());
  splitSharedPixels<Dimension>(sites, places, spacing, labels.data());
  digest.Add(labels);
}

TEST(Bits, SiteCells)
{
  Digest digest;
  addCells<1>({ 400 }, digest);
  addCells<2>({ 60, 45 }, digest);
  addCells<3>({ 12, 11, 14 }, digest);
  expectDigest("cells", digest);
}

template <int Dimension, class Real>
void addSplat(const GridSize<Dimension>& size, const SplatOptions& options, Digest& digest)
{
  std::mt19937_64 engine(11);
  constexpr std::int64_t count = 4000;
  std::vector<Real> points(3 * count);
  std::vector<double> masses(count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      points[3 * i + axis] =
        static_cast<Real>(uniformNumber(engine) * static_cast<double>(size[axis]));
    }
    masses[i] = uniformNumber(engine);
  }
  const SplatParticles<Dimension, Real> particles{ { points.data(), count }, masses.data(), 1.0,
    identityMap<Dimension>() };
  std::vector<double> cells(static_cast<std::size_t>(cellCount<Dimension>(size)));
  splatMass<Dimension, Real>(particles, size, options, 1.5, cells.data());
  digest.Add(cells);
}

TEST(Bits, Splat)
{
  for (const SplatKernel kernel : allKernels)
  {
    Digest digest;
    for (const SplatBoundary boundary : { SplatBoundary::Renormalize, SplatBoundary::Drop })
    {
      SplatOptions options;
      options.Kernel = kernel;
      options.Radius = 1.375;
      options.Boundary = boundary;
      addSplat<1, double>({ 90 }, options, digest);
      addSplat<2, double>({ 30, 41 }, options, digest);
      addSplat<2, float>({ 30, 41 }, options, digest);
      addSplat<3, double>({ 13, 17, 12 }, options, digest);
    }
    expectDigest("splat " + std::to_string(static_cast<int>(kernel)), digest);
  }
}

TEST(Bits, Neighbours)
{
  const Points<3> points = randomPoints<3>({ 5, 4, 3 }, 3000);
  std::vector<double> distances(points.size());
  nearestDistances(points, distances.data());
  Digest digest;
  digest.Add(distances);
  expectDigest("neighbours", digest);
}

} // namespace
} // namespace RectifiedTransport
