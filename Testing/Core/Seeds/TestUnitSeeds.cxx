// SPDX-License-Identifier: BSD-3-Clause
// Each pattern by one class: the count, then the points of the pattern's own function.
#include "../../SeedPatterns.h"
#include "Core/Seeds/SeedShare.h"
#include "Core/Seeds/UnitSeeds.h"
#include "TestRefusal.h"
#include "TestSeeds.h"
#include "ThreadRanks.h"

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
std::vector<double> generate(const UnitSeeds<Dimension>& seeds)
{
  const auto count = static_cast<std::int64_t>(seeds.Count());
  std::vector<double> points(count * Dimension);
  seeds.Generate({ points.data(), count });
  return points;
}

template <int Dimension>
void expectPatterns(const Point<Dimension>& lengths, const GridSize<Dimension>& grid)
{
  for (const SeedPattern pattern : scatteredPatterns)
  {
    const UnitSeeds<Dimension> scattered(pattern, lengths, 1000, 5);
    EXPECT_EQ(scattered.Count(), 1000.0);
    EXPECT_EQ(generate(scattered), seeds<Dimension>(pattern, lengths, 1000, 5));
  }
  // A lattice has the number of its grid.
  const GridSize<Dimension> nearest = latticeSize<Dimension>(lengths, 1000);
  const UnitSeeds<Dimension> lattice(SeedPattern::Lattice, lengths, 1000, 5);
  EXPECT_EQ(lattice.Count(), numberOfCells<Dimension>(nearest));
  std::vector<double> expected(static_cast<std::size_t>(lattice.Count()) * Dimension);
  generateLattice<Dimension>(
    nearest, { expected.data(), static_cast<std::int64_t>(lattice.Count()) });
  EXPECT_EQ(generate(lattice), expected);

  const auto cells = static_cast<std::int64_t>(numberOfCells<Dimension>(grid));
  expected.resize(static_cast<std::size_t>(cells * Dimension));
  generateLattice<Dimension>(grid, { expected.data(), cells });
  EXPECT_EQ(generate(UnitSeeds<Dimension>(SeedPattern::Lattice, grid, 5)), expected);
  generateJitteredLattice<Dimension>(grid, 5, { expected.data(), cells });
  EXPECT_EQ(generate(UnitSeeds<Dimension>(SeedPattern::Jittered, grid, 5)), expected);
}

TEST(UnitSeeds, ArePatterns)
{
  expectPatterns<1>({ 3.0 }, { 70 });
  expectPatterns<2>({ 4.0, 3.0 }, { 12, 7 });
  expectPatterns<3>({ 1.0, 5.0, 2.0 }, { 3, 5, 4 });
}

// The same bits as in the whole, whatever part is made.
template <int Dimension>
void expectParts(const UnitSeeds<Dimension>& seeds)
{
  const std::vector<double> whole = generate(seeds);
  const auto count = static_cast<std::int64_t>(seeds.Count());
  for (const std::int64_t parts : { 2, 3, 7 })
  {
    std::vector<double> joined;
    for (std::int64_t part = 0; part < parts; ++part)
    {
      const std::int64_t first = count * part / parts;
      const std::int64_t own = count * (part + 1) / parts - first;
      std::vector<double> points(static_cast<std::size_t>(own * Dimension));
      seeds.GenerateFrom(first, { points.data(), own });
      joined.insert(joined.end(), points.begin(), points.end());
    }
    EXPECT_EQ(joined, whole) << parts << " parts";
  }
}

template <int Dimension>
void expectPartsOfPatterns(const Point<Dimension>& lengths, const GridSize<Dimension>& grid)
{
  for (const SeedPattern pattern : seedPatterns)
  {
    for (const std::int64_t count : { 1, 5, 1000, 2600 })
    {
      expectParts(UnitSeeds<Dimension>(pattern, lengths, count, 5));
    }
  }
  expectParts(UnitSeeds<Dimension>(SeedPattern::Lattice, grid, 5));
  expectParts(UnitSeeds<Dimension>(SeedPattern::Jittered, grid, 5));
}

TEST(UnitSeeds, PartsAreThoseOfTheWhole)
{
  expectPartsOfPatterns<1>({ 3.0 }, { 70 });
  expectPartsOfPatterns<2>({ 4.0, 3.0 }, { 12, 7 });
  expectPartsOfPatterns<2>({ 4000.0, 1.0 }, { 1, 9 });
  expectPartsOfPatterns<2>({ 1.0, 9.0 }, { 5, 5 });
  expectPartsOfPatterns<3>({ 1.0, 5.0, 2.0 }, { 3, 5, 4 });
  expectPartsOfPatterns<3>({ 30.0, 0.1, 50.0 }, { 3, 1, 4 });
  expectPartsOfPatterns<3>({ 5000.0, 0.1, 0.1 }, { 30, 1, 1 });
}

TEST(UnitSeeds, CountsPastIntegers)
{
  const std::int64_t side = std::int64_t{ 1 } << 40;
  EXPECT_EQ(UnitSeeds<3>(SeedPattern::Jittered, { side, side, side }, 1).Count(), 0x1p120);
}

TEST(SeedShare, DividesAPatternOrCountsGivenSeeds)
{
  const SeedShare second(10.0, 3, 1);
  EXPECT_EQ(second.First, 4);
  EXPECT_EQ(second.Count, 3.0);
  EXPECT_EQ(second.All, 10);
  EXPECT_EQ(SeedShare(1e20, 2, 0).Count, 5e19); // no integer is as large
  runOnRanks(3, [](const Ranks& ranks) {
    const SeedShare given(std::int64_t{ 2 } + ranks.Own(), ranks);
    EXPECT_EQ(given.First, ranks.Own() == 0 ? 0 : ranks.Own() == 1 ? 2 : 5);
    EXPECT_EQ(given.Count, 2.0 + ranks.Own());
    EXPECT_EQ(given.All, 9);
  });
}

TEST(SeedShare, WritesSeedsInIndexSpace)
{
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  const UnitSeeds<2> pattern(SeedPattern::Random, { 1.0, 1.0 }, 10, 1);
  const std::vector<double> unit = generate(pattern);
  std::vector<double> points(6);
  writeSeeds<2>(pattern, { 4, 8 }, 2, progress, { points.data(), 3 });
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(points[i], unit[4 + i] * (i % 2 == 0 ? 4.0 : 8.0));
  }
}

TEST(UnitSeeds, Refused)
{
  EXPECT_EQ(refusal([]() {
    UnitSeeds<2>(SeedPattern::BlueNoise, { 4, 4 }, 1);
  }),
    "seeds in each cell of a grid are of the pattern Lattice or Jittered");
  const UnitSeeds<2> seeds(SeedPattern::Random, { 1.0, 1.0 }, 10, 1);
  std::vector<Point<2>> points(9);
  EXPECT_EQ(
    refusal([&]() { seeds.Generate(points); }), "there is memory for 9 seeds, there must be 10");
  const std::string tooMany = "there are 10 seeds, not 9 from number 2 on";
  EXPECT_EQ(refusal([&]() { seeds.GenerateFrom(2, points); }), tooMany);
  EXPECT_EQ(refusal([&]() {
    UnitSeeds<2>(SeedPattern::Lattice, { 2, 5 }, 1).GenerateFrom(2, points);
  }),
    tooMany);
}

} // namespace
} // namespace RectifiedTransport
