// SPDX-License-Identifier: BSD-3-Clause
// The figures of particles that are known: lattices, particles in one place, all in one half.
#include "Core/Quality/ParticleQuality.h"

#include "TestDensities.h"
#include "TestGrid.h"
#include "TestTiles.h"
#include "ThreadRanks.h"

#include "Core/Geometry/ReproducibleMath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
TestDensity<Dimension> uniform(const GridSize<Dimension>& size, double value = 1.0)
{
  TestDensity<Dimension> density{ size, {} };
  density.Values.assign(static_cast<std::size_t>(cellCount<Dimension>(size)), value);
  return density;
}

template <int Dimension>
ParticleQuality qualityOf(const TestDensity<Dimension>& density, const ImageGrid& grid,
  const ParticleSample& particles, std::int64_t blockSize = 1, const Context& context = Context())
{
  const RectifiedFlow<Dimension> flow(density.Source());
  return measureQuality<Dimension>(particles, flow, grid, blockSize, context);
}

// One in the middle of each cell.
template <int Dimension>
std::vector<Point<3>> centresOf(const GridSize<Dimension>& size, const ImageGrid& grid)
{
  std::vector<Point<3>> centres(static_cast<std::size_t>(cellCount<Dimension>(size)));
  for (std::size_t i = 0; i < centres.size(); ++i)
  {
    const auto cell = cellAt<Dimension>(static_cast<std::int64_t>(i), size);
    Point<Dimension> index;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      index[axis] = static_cast<double>(cell[axis]) + 0.5;
    }
    grid.ToPhysical<Dimension>(index.data(), centres[i].data());
  }
  return centres;
}

// A cubic lattice is as near to the densest one as its packing is, wherever and however large.
template <int Dimension>
void expectLattice(const GridSize<Dimension>& size, double spacing, double unit)
{
  const auto grid = makeGrid<Dimension>(size, { unit, unit, unit }, { 8 * unit, -unit, 0.0 });
  const auto centres = centresOf<Dimension>(size, grid);
  const ParticleQuality quality =
    qualityOf<Dimension>(uniform<Dimension>(size, 0.5), grid, { centres });
  EXPECT_EQ(quality.Particles, cellCount<Dimension>(size));
  EXPECT_EQ(quality.Outside, 0);
  EXPECT_EQ(quality.InEmptyCells, 0);
  EXPECT_NEAR(quality.TotalMass,
    0.5 * static_cast<double>(cellCount<Dimension>(size)) * std::pow(unit, Dimension), 1e-12);
  EXPECT_NEAR(quality.DensityError, 0.0, 1e-12);
  EXPECT_EQ(quality.TransportCost, 0.0);
  EXPECT_NEAR(quality.SmallestSpacing, spacing, 1e-9);
  EXPECT_NEAR(quality.MeanSpacing, spacing, 1e-9);
}

TEST(ParticleQuality, Lattices)
{
  for (const double unit : { 1.0, 0.03125, 0.3 })
  {
    expectLattice<1>({ 20 }, 1.0, unit);
    expectLattice<2>({ 12, 9 }, std::sqrt(std::sqrt(3.0) / 2.0), unit);
    expectLattice<3>({ 6, 5, 4 }, 1.0 / std::cbrt(std::sqrt(2.0)), unit);
  }
}

// With shares p and m of blocks of one size the error is |p - m| / |m|.
TEST(ParticleQuality, AllInOneHalf)
{
  const auto grid = makeGrid<2>({ 8, 4 }, { 0.5, 0.5, 1.0 });
  const std::vector<Point<3>> points = { { 0.3, 0.3, 0.0 }, { 1.1, 1.9, 0.0 }, { 1.7, 1.0, 0.0 } };
  const auto density = uniform<2>({ 8, 4 });
  EXPECT_NEAR(qualityOf<2>(density, grid, { points }, 4).DensityError, 1.0, 1e-14);
  EXPECT_NEAR(qualityOf<2>(density, grid, { points }, 8).DensityError, 0.0, 1e-14);
  EXPECT_NEAR(qualityOf<2>(density, grid, { points }, 4).Blocks.Largest, 1.0, 1e-14);
  EXPECT_NEAR(qualityOf<2>(density, grid, { points }, 8).Blocks.Largest, 0.0, 1e-14);
}

// Blocks count if their mean density is more than a twentieth of that of all.
TEST(ParticleQuality, ThinBlocks)
{
  const auto grid = makeGrid<1>({ 5 }, { 1.0, 1.0, 1.0 }); // the last block has one cell
  const std::vector<Point<3>> points = { { 0.5, 0.0, 0.0 }, { 1.5, 0.0, 0.0 }, { 4.5, 0.0, 0.0 } };
  const auto errorsOf = [&](double thin) {
    const TestDensity<1> density{ { 5 }, { 1.0, 1.0, thin, thin, 1.0 } };
    return qualityOf<1>(density, grid, { points }, 2).Blocks;
  };
  EXPECT_NEAR(errorsOf(0.03).Largest, 0.02, 1e-14); // 2/3 for 2/3.06
  EXPECT_NEAR(errorsOf(0.04).Largest, 1.0, 1e-14);  // empty
  EXPECT_NEAR(errorsOf(0.03).Quantile, 0.02, 1e-14);
}

TEST(ParticleQuality, BlocksOfManyParticles)
{
  EXPECT_EQ(blockSizeFor<2>({ 1024, 1024 }, 16384, 64.0), 64);
  EXPECT_EQ(blockSizeFor<2>({ 1024, 1024 }, 16383, 64.0), 65); // at least as many
  EXPECT_EQ(blockSizeFor<3>({ 40, 20, 10 }, 8000, 64.0), 4);
  EXPECT_EQ(blockSizeFor<1>({ 1000 }, 6400, 64.0), 10);
  EXPECT_EQ(blockSizeFor<2>({ 1000, 2 }, 2000, 64.0), 32); // the second axis has no more
  EXPECT_EQ(blockSizeFor<2>({ 30, 50 }, 10, 64.0), 50);    // one block
  EXPECT_EQ(blockSizeFor<2>({ 8, 8 }, 1000000, 64.0), 1);
}

TEST(ParticleQuality, MassesWeigh)
{
  const auto grid = makeGrid<1>({ 2 }, { 3.0, 1.0, 1.0 });
  const std::vector<Point<3>> points = { { 1.0, 0.0, 0.0 }, { 5.0, 0.0, 0.0 } };
  const std::vector<Point<3>> displacements = { { 3.0, 4.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  const double masses[] = { 30.0, 10.0 };
  const TestDensity<1> density{ { 2 }, { 6.0, 2.0 } };
  const ParticleQuality even = qualityOf<1>(density, grid, { points, nullptr, displacements });
  EXPECT_NEAR(even.DensityError, std::sqrt(2 * 0.0625 / (0.5625 + 0.0625)), 1e-14);
  EXPECT_NEAR(even.TransportCost, 13.0, 1e-14);
  const ParticleQuality weighted = qualityOf<1>(density, grid, { points, masses, displacements });
  EXPECT_NEAR(weighted.DensityError, 0.0, 1e-14);
  EXPECT_NEAR(weighted.TransportCost, 19.0, 1e-14);
  // The boxes about the particles that hold three quarters and one quarter.
  EXPECT_NEAR(weighted.MeanSpacing, 0.5 * (4.0 / 3.0 + 4.0 / 3.0), 1e-9);
}

TEST(ParticleQuality, OutsideAndInEmptyCells)
{
  const auto grid = makeGrid<2>({ 2, 2 }, { 1.0, 1.0, 1.0 });
  const TestDensity<2> density{ { 2, 2 }, { 1.0, 0.0, 1.0, 1.0 } };
  const std::vector<Point<3>> points = { { 0.5, 0.5, 0.0 }, { 1.5, 0.5, 0.0 }, { 0.5, 1.5, 0.1 },
    { 2.0 + 1e-8, 1.5, 0.0 }, { 2.001, 1.5, 0.0 }, { -7.0, 0.5, 0.0 } };
  const ParticleQuality quality = qualityOf<2>(density, grid, { points });
  EXPECT_EQ(quality.Particles, 6);
  EXPECT_EQ(quality.Outside, 3);
  EXPECT_EQ(quality.InEmptyCells, 1);
}

TEST(ParticleQuality, OneParticleHasNoSpacing)
{
  const std::vector<Point<3>> points = { { 0.5, 0.0, 0.0 } };
  const ParticleQuality quality =
    qualityOf<1>(uniform<1>({ 4 }), makeGrid<1>({ 4 }, { 1.0, 1.0, 1.0 }), { points });
  EXPECT_EQ(quality.SmallestSpacing, 0.0);
  EXPECT_EQ(quality.MeanSpacing, 0.0);
}

TEST(ParticleQuality, WhatIsWrong)
{
  const auto grid = makeGrid<1>({ 4 }, { 1.0, 1.0, 1.0 });
  const std::vector<Point<3>> points = { { 0.5, 0.0, 0.0 }, { 1.5, 0.0, 0.0 } };
  const double none[] = { 0.0, 0.0 };
  const double huge[] = { 1e308, 1e308 };
  EXPECT_THROW(qualityOf<1>(uniform<1>({ 4 }), grid, { points }, 0), std::invalid_argument);
  EXPECT_THROW(qualityOf<1>(uniform<1>({ 4 }), grid, { points, none, {} }), std::invalid_argument);
  EXPECT_THROW(qualityOf<1>(uniform<1>({ 4 }), grid, { points, huge, {} }), std::invalid_argument);

  const auto needles = makeGrid<3>({ 4, 3, 3 }, { 1e300, 1e-200, 1e-200 });
  const std::vector<Point<3>> far = { { 5e299, 0.0, 0.0 }, { 2.5e300, 0.0, 0.0 } };
  EXPECT_THROW(qualityOf<3>(uniform<3>({ 4, 3, 3 }), needles, { far }), std::overflow_error);
}

TEST(ParticleQuality, SameBitsOnAnyThreads)
{
  const auto density = twoGaussians<2>({ 60, 50 });
  const auto grid = makeGrid<2>({ 60, 50 }, { 0.7, 1.3, 1.0 });
  std::mt19937_64 engine(3);
  std::vector<Point<3>> points(20000);
  std::vector<double> masses;
  for (Point<3>& point : points)
  {
    point = { 45.0 * uniformNumber(engine), 70.0 * uniformNumber(engine), 0.0 };
    masses.push_back(uniformNumber(engine));
  }
  const ParticleSample sample{ points, masses.data(), points };
  const ParticleQuality one = qualityOf<2>(density, grid, sample, 7, SerialExecutor());
  const ParticleQuality many = qualityOf<2>(density, grid, sample, 7);
  EXPECT_GT(one.Outside, 0);
  EXPECT_EQ(one.Outside, many.Outside);
  EXPECT_EQ(one.DensityError, many.DensityError);
  EXPECT_EQ(one.Blocks.Largest, many.Blocks.Largest);
  EXPECT_EQ(one.TransportCost, many.TransportCost);
  EXPECT_EQ(one.SmallestSpacing, many.SmallestSpacing);
  EXPECT_EQ(one.MeanSpacing, many.MeanSpacing);
}

// The particles of one rank.
struct RankParticles
{
  std::vector<Point<3>> Points;
  std::vector<double> Masses;
  std::vector<Point<3>> Displacements;
  std::vector<std::int64_t> Order;
};

// All of them, and those of the ranks: divided by place, or without regard to it; the last rank has
// none.
struct DividedParticles
{
  RankParticles All;
  std::vector<RankParticles> Of;
};

template <int Dimension>
DividedParticles makeParticles(
  const GridSize<Dimension>& size, const ImageGrid& grid, int ranks, bool byPlace)
{
  DividedParticles divided;
  divided.Of.resize(static_cast<std::size_t>(ranks));
  for (std::int64_t i = 0; i < 1500; ++i)
  {
    const auto word = [i](std::uint64_t seed) {
      return unitReal(randomWord(seed, static_cast<std::uint64_t>(i)));
    };
    Point<Dimension> index;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double place = 1.01 * word(static_cast<std::uint64_t>(axis)) - 0.005; // some outside
      index[axis] = place * static_cast<double>(size[axis]);
    }
    Point<3> point;
    grid.template ToPhysical<Dimension>(index.data(), point.data());
    const int owner = byPlace
      ? static_cast<int>(std::clamp(index[0] / static_cast<double>(size[0]), 0.0, 0.999) * ranks)
      : static_cast<int>(i * 7 % 11 % ranks);
    RankParticles& own = divided.Of[static_cast<std::size_t>(owner + 1 == ranks ? 0 : owner)];
    for (RankParticles* particles : { &divided.All, &own })
    {
      particles->Points.push_back(i % 500 == 499 ? Point<3>{ 9.0, 0.0, 0.0 } : point);
      particles->Masses.push_back(word(7) + 0.1);
      particles->Displacements.push_back({ word(8), word(9), word(10) });
      particles->Order.push_back(5 * i - 700);
    }
  }
  // As moved, those of a rank are in no order.
  for (RankParticles& own : divided.Of)
  {
    std::reverse(own.Points.begin(), own.Points.end());
    std::reverse(own.Masses.begin(), own.Masses.end());
    std::reverse(own.Displacements.begin(), own.Displacements.end());
    std::reverse(own.Order.begin(), own.Order.end());
  }
  return divided;
}

ParticleSample sampleOf(const RankParticles& particles, bool hasMasses)
{
  return { particles.Points, hasMasses ? particles.Masses.data() : nullptr, particles.Displacements,
    particles.Order.data() };
}

void expectSame(const ParticleQuality& found, const ParticleQuality& expected)
{
  EXPECT_EQ(found.Particles, expected.Particles);
  EXPECT_EQ(found.TotalMass, expected.TotalMass);
  EXPECT_EQ(found.Outside, expected.Outside);
  EXPECT_EQ(found.InEmptyCells, expected.InEmptyCells);
  EXPECT_EQ(found.DensityError, expected.DensityError);
  EXPECT_EQ(found.Blocks.Quantile, expected.Blocks.Quantile);
  EXPECT_EQ(found.Blocks.Largest, expected.Blocks.Largest);
  EXPECT_EQ(found.TransportCost, expected.TransportCost);
  EXPECT_EQ(found.SmallestSpacing, expected.SmallestSpacing);
  EXPECT_EQ(found.MeanSpacing, expected.MeanSpacing);
}

template <int Dimension>
ImageGrid unevenGrid(const GridSize<Dimension>& size)
{
  return makeGrid<Dimension>(size, { 0.5, 0.7, 1.3 }, { 8.0, -1.0, 0.0 });
}

template <int Dimension>
void checkOnRanks(const GridSize<Dimension>& size, int ranks, bool byPlace, bool hasMasses)
{
  const auto grid = unevenGrid<Dimension>(size);
  const auto density = randomCells<Dimension>(size, 0.0, 5);
  const DividedParticles particles = makeParticles<Dimension>(size, grid, ranks, byPlace);
  const RectifiedFlow<Dimension> flow(density.Source());
  const ParticleQuality expected =
    measureQuality<Dimension>(sampleOf(particles.All, hasMasses), flow, grid, 3);
  EXPECT_GT(expected.MeanSpacing, 0.0);
  EXPECT_GT(expected.Outside, 0);
  runOnRanks(ranks, [&](const Ranks& group) {
    const RankParticles& own = particles.Of[static_cast<std::size_t>(group.Own())];
    const SerialExecutor serial;
    Context context(serial);
    context.Group = &group;
    expectSame(
      measureQuality<Dimension>(sampleOf(own, hasMasses), flow, grid, 3, context), expected);
  });
}

TEST(ParticleQuality, TheSameBitsOnRanks)
{
  for (const int ranks : { 2, 3, 5 })
  {
    for (const bool byPlace : { false, true })
    {
      for (const bool hasMasses : { false, true })
      {
        checkOnRanks<1>({ 40 }, ranks, byPlace, hasMasses);
        checkOnRanks<2>({ 30, 20 }, ranks, byPlace, hasMasses);
        checkOnRanks<3>({ 12, 9, 7 }, ranks, byPlace, hasMasses);
      }
    }
  }
}

// A density that no rank has as a whole, in blocks that are narrow and that cover all of it.
template <int Dimension>
void checkOnTiles(const GridSize<Dimension>& size, std::int64_t blockSize)
{
  const TileLimits limits = tileLimits<Dimension>(8000, 40000, 20);
  const auto grid = unevenGrid<Dimension>(size);
  const auto density = randomCells<Dimension>(size, 0.0, 5);
  const RectifiedFlow<Dimension> whole(density.Source());
  const TiledRun<Dimension> tiled(density, limits);
  for (const int ranks : { 2, 3, 5 })
  {
    const DividedParticles particles = makeParticles<Dimension>(size, grid, ranks, ranks == 3);
    const ParticleSample all = sampleOf(particles.All, ranks != 2);
    const ParticleQuality expected = measureQuality<Dimension>(all, tiled.Flow, grid, blockSize);
    const ParticleQuality byWhole = measureQuality<Dimension>(all, whole, grid, blockSize);
    EXPECT_EQ(expected.Outside, byWhole.Outside);
    EXPECT_EQ(expected.InEmptyCells, byWhole.InEmptyCells);
    EXPECT_NEAR(expected.DensityError, byWhole.DensityError, 1e-12);
    EXPECT_NEAR(expected.MeanSpacing, byWhole.MeanSpacing, 1e-6);
    EXPECT_NEAR(expected.SmallestSpacing, byWhole.SmallestSpacing, 1e-6);
    runOnRanks(ranks, [&](const Ranks& group) {
      const RankParticles& own = particles.Of[static_cast<std::size_t>(group.Own())];
      const RankFlow<Dimension> run(density, group, limits);
      expectSame(measureQuality<Dimension>(
                   sampleOf(own, ranks != 2), run.Flow, grid, blockSize, run.RankContext()),
        expected);
    });
  }
}

TEST(ParticleQuality, ByTilesOnRanks)
{
  checkOnTiles<2>({ 131, 97 }, 5);
  checkOnTiles<2>({ 131, 97 }, 200);
  checkOnTiles<3>({ 51, 43, 47 }, 6);
}

} // namespace
} // namespace RectifiedTransport
