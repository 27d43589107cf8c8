// SPDX-License-Identifier: BSD-3-Clause
// What all seed patterns promise, and lattices. Spacing is in TestSeedsBlueNoise.cxx.
#include "TestSeeds.h"
#include "../../SeedPatterns.h"
#include "TestRefusal.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
std::vector<Point<Dimension>> boxes();

template <>
std::vector<Point<1>> boxes<1>()
{
  return { { 1.0 }, { 1e-300 } };
}

template <>
std::vector<Point<2>> boxes<2>()
{
  return { { 1.0, 1.0 }, { 4.0, 3.0 }, { 1.0, 100.0 }, { 40000.0, 4.0 }, { 1e-300, 1e300 } };
}

template <>
std::vector<Point<3>> boxes<3>()
{
  return { { 1.0, 1.0, 1.0 }, { 3.0, 1.0, 2.0 }, { 1.0, 100.0, 1.0 }, { 1.0, 70.0, 100.0 },
    { 1e300, 1e-300, 1.0 } };
}

template <int Dimension>
void checkPromises()
{
  constexpr double guard = -7.0;
  for (SeedPattern pattern : scatteredPatterns)
  {
    for (const Point<Dimension>& lengths : boxes<Dimension>())
    {
      for (std::int64_t count : { 0, 1, 2, 3, 5, 17, 100, 1021, 8192 })
      {
        SCOPED_TRACE(testing::Message() << "pattern " << static_cast<int>(pattern) << ", "
                                        << testing::PrintToString(lengths) << ", " << count);
        std::vector<double> points(count * Dimension + 1, guard);
        generateSeeds<Dimension>(pattern, lengths, 1, { points.data(), count });
        EXPECT_EQ(points.back(), guard);
        points.pop_back();
        for (double coordinate : points)
        {
          ASSERT_GE(coordinate, 0.0);
          ASSERT_LE(coordinate, 1.0);
        }
        EXPECT_EQ(points, seeds<Dimension>(pattern, lengths, count, 1));
        if (count > 0)
        {
          EXPECT_NE(points, seeds<Dimension>(pattern, lengths, count, 2));
        }
      }
    }
  }
}

TEST(Seeds, AreExactlyAsManyInTheBoxAndReproducible)
{
  checkPromises<1>();
  checkPromises<2>();
  checkPromises<3>();
}

// The coordinates' bits must not depend on compiler, optimisation or machine.
template <int Dimension>
std::uint64_t fingerprint(SeedPattern pattern, const Point<Dimension>& lengths)
{
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (double coordinate : seeds<Dimension>(pattern, lengths, 10007, 11))
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &coordinate, sizeof(bits));
    hash = (hash ^ bits) * 0x100000001B3u;
  }
  return hash;
}

TEST(Seeds, HaveTheSameBitsEverywhere)
{
  EXPECT_EQ(fingerprint<1>(SeedPattern::BlueNoise, { 1.0 }), 0xEF78C460CF2716CFu);
  EXPECT_EQ(fingerprint<2>(SeedPattern::BlueNoise, { 4.0, 3.0 }), 0x79CFE3879E8B8654u);
  EXPECT_EQ(fingerprint<2>(SeedPattern::BlueNoise, { 1.0, 1e6 }), 0x5DBCA40AE8D4E832u);
  EXPECT_EQ(fingerprint<3>(SeedPattern::BlueNoise, { 4.0, 3.0, 2.0 }), 0x2EEF35A5C2496105u);
  EXPECT_EQ(fingerprint<3>(SeedPattern::Jittered, { 4.0, 3.0, 2.0 }), 0xC4DB59CD62FD92D2u);
  EXPECT_EQ(fingerprint<3>(SeedPattern::LowDiscrepancy, { 1.0, 1.0, 1.0 }), 0x0CA1FF29DE67EE6Fu);
  EXPECT_EQ(fingerprint<3>(SeedPattern::Random, { 1.0, 1.0, 1.0 }), 0x0D19ADD6F9A7A2A8u);
}

template <int Dimension>
void checkPrefix(SeedPattern pattern)
{
  const Point<Dimension> cube = evenPoint<Dimension>(1.0);
  const std::vector<double> all = seeds<Dimension>(pattern, cube, 1000, 3);
  const std::vector<double> some = seeds<Dimension>(pattern, cube, 10, 3);
  EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin()));
}

TEST(Seeds, OfSequencesDoNotDependOnTheCount)
{
  for (SeedPattern pattern : { SeedPattern::Random, SeedPattern::LowDiscrepancy })
  {
    checkPrefix<1>(pattern);
    checkPrefix<2>(pattern);
    checkPrefix<3>(pattern);
  }
}

// The counts in the cubes of a grid on the unit box, 8, 8 x 8 or 4 x 4 x 4, summed over the seeds
// from firstSeed on.
template <int Dimension>
std::vector<int> blockCounts(SeedPattern pattern, const Point<Dimension>& lengths,
  std::int64_t count, int firstSeed, int numberOfSeeds)
{
  constexpr int side = Dimension == 3 ? 4 : 8;
  std::vector<int> counts(Dimension == 1 ? 8 : 64, 0);
  for (int seed = firstSeed; seed < firstSeed + numberOfSeeds; ++seed)
  {
    const std::vector<double> points = seeds<Dimension>(pattern, lengths, count, seed);
    for (std::int64_t i = 0; i < count; ++i)
    {
      int block = 0;
      for (int a = 0; a < Dimension; ++a)
      {
        block =
          block * side + std::min(static_cast<int>(points[i * Dimension + a] * side), side - 1);
      }
      ++counts[block];
    }
  }
  return counts;
}

// A strip of about three mean spacings holds three rows of blue noise, which blocks across it tell
// apart: sums these.
std::vector<int> alongStrip(const std::vector<int>& counts)
{
  std::vector<int> sums(8, 0);
  for (std::size_t block = 0; block < counts.size(); ++block)
  {
    sums[block % 8] += counts[block];
  }
  return sums;
}

template <int Dimension>
void checkUniformity()
{
  constexpr int numberOfSeeds = 50;
  for (SeedPattern pattern : scatteredPatterns)
  {
    for (const Point<Dimension>& lengths : boxes<Dimension>())
    {
      SCOPED_TRACE(testing::Message()
        << "pattern " << static_cast<int>(pattern) << ", " << testing::PrintToString(lengths));
      auto counts = blockCounts<Dimension>(pattern, lengths, 1000, 0, numberOfSeeds);
      if (Dimension == 2 && lengths[1] == 100.0 && pattern == SeedPattern::BlueNoise)
      {
        counts = alongStrip(counts);
      }
      const double mean = 1000.0 * numberOfSeeds / static_cast<double>(counts.size());
      for (int count : counts)
      {
        EXPECT_NEAR(count, mean, 4.5 * std::sqrt(mean)); // Random's own fluctuation
      }
    }
  }
}

TEST(Seeds, AreUniform)
{
  checkUniformity<1>();
  checkUniformity<2>();
  checkUniformity<3>();
}

// The variance of the counts in blocks over that of independent points.
template <int Dimension>
double clumping(SeedPattern pattern)
{
  const Point<Dimension> cube = evenPoint<Dimension>(1.0);
  double sum = 0.0;
  constexpr int numberOfSeeds = 20;
  for (int seed = 0; seed < numberOfSeeds; ++seed)
  {
    const auto counts = blockCounts<Dimension>(pattern, cube, 4001 + 97 * seed, seed, 1);
    const double mean = (4001.0 + 97.0 * seed) / static_cast<double>(counts.size());
    for (int count : counts)
    {
      sum += (count - mean) * (count - mean) / mean;
    }
  }
  return sum / (numberOfSeeds * (Dimension == 1 ? 8.0 : 64.0));
}

TEST(Seeds, AreSpreadMoreEvenlyThanAtRandom)
{
  EXPECT_NEAR(clumping<2>(SeedPattern::Random), 1.0, 0.15);
  EXPECT_NEAR(clumping<3>(SeedPattern::Random), 1.0, 0.15);
  for (SeedPattern pattern :
    { SeedPattern::BlueNoise, SeedPattern::Jittered, SeedPattern::LowDiscrepancy })
  {
    SCOPED_TRACE(testing::Message() << "pattern " << static_cast<int>(pattern));
    EXPECT_LT(clumping<1>(pattern), 0.01);
    EXPECT_LT(clumping<2>(pattern), 0.15);
    EXPECT_LT(clumping<3>(pattern), 0.4);
  }
}

// Whether the points fill one box each of `slabs` slabs across axis `across`, each as thick as its
// share of the points and cut into boxes of equal length along the other axis.
bool oneInEachBox(const std::vector<double>& points, int across, std::int64_t slabs)
{
  const std::int64_t count = static_cast<std::int64_t>(points.size()) / 2;
  std::vector<int> found(count, 0);
  for (std::int64_t i = 0; i < count; ++i)
  {
    std::int64_t begin = 0;
    for (std::int64_t slab = 0; slab < slabs; ++slab)
    {
      const std::int64_t size = count / slabs + (slab < count % slabs ? 1 : 0);
      if (points[2 * i + across] * static_cast<double>(count) < static_cast<double>(begin + size))
      {
        const double along = points[2 * i + 1 - across] * static_cast<double>(size);
        ++found[begin + std::min(static_cast<std::int64_t>(along), size - 1)];
        break;
      }
      begin += size;
    }
  }
  return std::all_of(found.begin(), found.end(), [](int n) { return n == 1; });
}

TEST(JitteredSeeds, LieOneInEachOfEqualBoxesAlmostSquare)
{
  for (std::int64_t count : { 1, 2, 7, 100, 101, 1021, 8192 })
  {
    for (const double aspect : { 1.0, 0.75, 0.1, 0.0001 })
    {
      const double ideal = std::sqrt(static_cast<double>(count) * aspect);
      const auto slabs = std::max<std::int64_t>(1, std::llround(ideal));
      SCOPED_TRACE(testing::Message() << count << " points, aspect " << aspect);
      EXPECT_TRUE(
        oneInEachBox(seeds<2>(SeedPattern::Jittered, { 1.0, aspect }, count, 5), 1, slabs));
      const auto random = seeds<2>(SeedPattern::Random, { 1.0, aspect }, count, 5);
      EXPECT_EQ(oneInEachBox(random, 1, slabs), count == 1);
    }
  }
}

TEST(JitteredSeeds, LieOneInEachCubeOfACube)
{
  const auto points = seeds<3>(SeedPattern::Jittered, { 2.0, 2.0, 2.0 }, 1000, 9);
  std::vector<int> found(1000, 0);
  for (int i = 0; i < 1000; ++i)
  {
    const double* p = &points[3 * i];
    ++found[static_cast<int>(10 * p[0]) + 10 * static_cast<int>(10 * p[1]) +
      100 * static_cast<int>(10 * p[2])];
  }
  EXPECT_EQ(found, std::vector<int>(1000, 1));
}

// The largest difference between share of points and volume of many boxes at the origin.
template <int Dimension>
double discrepancy(const std::vector<double>& points)
{
  const std::int64_t count = static_cast<std::int64_t>(points.size()) / Dimension;
  const auto corners = seeds<Dimension>(SeedPattern::Random, evenPoint<Dimension>(1.0), 500, 77);
  double largest = 0.0;
  for (int k = 0; k < 500; ++k)
  {
    const double* corner = &corners[k * Dimension];
    double volume = 1.0;
    for (int a = 0; a < Dimension; ++a)
    {
      volume *= corner[a];
    }
    std::int64_t inside = 0;
    for (std::int64_t i = 0; i < count; ++i)
    {
      bool in = true;
      for (int a = 0; a < Dimension; ++a)
      {
        in = in && points[i * Dimension + a] < corner[a];
      }
      inside += in ? 1 : 0;
    }
    const double share = static_cast<double>(inside) / static_cast<double>(count);
    largest = std::max(largest, std::abs(share - volume));
  }
  return largest;
}

template <int Dimension>
void checkDiscrepancy(double limit)
{
  const Point<Dimension> cube = evenPoint<Dimension>(1.0);
  double low = 0.0;
  double random = 0.0;
  for (int seed = 0; seed < 5; ++seed)
  {
    low += discrepancy<Dimension>(seeds<Dimension>(SeedPattern::LowDiscrepancy, cube, 2000, seed));
    random += discrepancy<Dimension>(seeds<Dimension>(SeedPattern::Random, cube, 2000, seed));
  }
  EXPECT_LT(low, limit * random);
  EXPECT_GT(low, 0.0);
}

TEST(LowDiscrepancySeeds, AreFarMoreEvenThanRandomOnes)
{
  checkDiscrepancy<1>(0.1);
  checkDiscrepancy<2>(0.2);
  checkDiscrepancy<3>(0.4);
}

TEST(LowDiscrepancySeeds, KeepTheirStepAfterAMillionPoints)
{
  // The powers of 1 / phi, phi^4 = phi + 1.
  const double phi = 1.2207440846057594754;
  const std::int64_t count = 1000002;
  const auto points = seeds<3>(SeedPattern::LowDiscrepancy, { 1.0, 1.0, 1.0 }, count, 4);
  double power = 1.0;
  for (int a = 0; a < 3; ++a)
  {
    power /= phi;
    for (std::int64_t i : { std::int64_t(0), count - 2 })
    {
      const double step = points[3 * (i + 1) + a] - points[3 * i + a];
      EXPECT_NEAR(step < 0.0 ? step + 1.0 : step, power, 1e-15);
    }
  }
}

TEST(Lattice, HasTheKnownSizes)
{
  EXPECT_EQ(latticeSize<1>({ 3.0 }, 77), (GridSize<1>{ 77 }));
  EXPECT_EQ(latticeSize<2>({ 1.0, 1.0 }, 10000), (GridSize<2>{ 100, 100 }));
  EXPECT_EQ(latticeSize<2>({ 4.0, 3.0 }, 8192), (GridSize<2>{ 105, 78 }));
  // Cells too short are as bad as cells too long.
  EXPECT_EQ(latticeSize<2>({ 3.0, 2.0 }, 12), (GridSize<2>{ 4, 3 }));
  EXPECT_EQ(latticeSize<2>({ 4.0, 3.0 }, 4), (GridSize<2>{ 2, 2 }));
  EXPECT_EQ(latticeSize<2>({ 40000.0, 4.0 }, 8192), (GridSize<2>{ 8192, 1 }));
  EXPECT_EQ(latticeSize<2>({ 1e-300, 1e300 }, 50), (GridSize<2>{ 1, 50 }));
  EXPECT_EQ(latticeSize<3>({ 1.0, 1.0, 1.0 }, 1000), (GridSize<3>{ 10, 10, 10 }));
  EXPECT_EQ(latticeSize<3>({ 1.0, 1.0, 1.0 }, 8192), (GridSize<3>{ 20, 20, 20 }));
  EXPECT_EQ(latticeSize<3>({ 2.0, 1.0, 1.0 }, 16), (GridSize<3>{ 4, 2, 2 }));
  EXPECT_EQ(latticeSize<3>({ 100.0, 100.0, 0.001 }, 10000), (GridSize<3>{ 100, 100, 1 }));
  EXPECT_EQ(latticeSize<3>({ 1.0, 2.0, 3.0 }, 1), (GridSize<3>{ 1, 1, 1 }));
  EXPECT_EQ(latticeSize<3>({ 1.0, 2.0, 3.0 }, 0), (GridSize<3>{ 0, 0, 0 }));
}

template <int Dimension>
void checkLatticeSizes(double largestMiss, double longestCell)
{
  const auto exponents = seeds<Dimension>(SeedPattern::Random, evenPoint<Dimension>(1.0), 2000, 1);
  for (int k = 0; k < 2000; ++k)
  {
    Point<Dimension> lengths;
    for (int a = 0; a < Dimension; ++a)
    {
      lengths[a] = std::pow(4.0, exponents[k * Dimension + a]);
    }
    const double count = std::floor(1000.0 * std::pow(1.004, k));
    const auto size = latticeSize<Dimension>(lengths, static_cast<std::int64_t>(count));
    double total = 1.0;
    double longest = 0.0;
    double shortest = std::numeric_limits<double>::infinity();
    for (int a = 0; a < Dimension; ++a)
    {
      total *= static_cast<double>(size[a]);
      longest = std::max(longest, lengths[a] / static_cast<double>(size[a]));
      shortest = std::min(shortest, lengths[a] / static_cast<double>(size[a]));
    }
    EXPECT_NEAR(total / count, 1.0, largestMiss);
    EXPECT_LT(longest / shortest, longestCell);
  }
}

TEST(Lattice, IsAsNearAsTheAspectAllows)
{
  checkLatticeSizes<2>(0.02, 1.1);
  checkLatticeSizes<3>(0.06, 1.5);
}

TEST(Lattice, HasPointsAtTheCentresOfItsCells)
{
  std::vector<double> points(12);
  generateLattice<2>({ 3, 2 }, { points.data(), 6 });
  const std::vector<double> expected = { 0.5 / 3, 0.25, 0.5, 0.25, 2.5 / 3, 0.25, 0.5 / 3, 0.75,
    0.5, 0.75, 2.5 / 3, 0.75 };
  EXPECT_EQ(points, expected);
  std::vector<double> jittered(12);
  generateJitteredLattice<2>({ 3, 2 }, 8, { jittered.data(), 6 });
  EXPECT_NE(points, jittered);
  for (int i = 0; i < 12; ++i)
  {
    EXPECT_NEAR(jittered[i], points[i], i % 2 == 0 ? 0.5 / 3 : 0.25);
  }
  generateLattice<3>({ 0, 2, 5 }, {});
}

TEST(Seeds, RefuseWhatTheyCannotMake)
{
  double point[2];
  EXPECT_EQ(refusal([&] {
    generateSeeds<2>(SeedPattern::Random, { 1.0, 1.0 }, 1, { point, -3 });
  }),
    "the number of seeds must not be negative, but is -3");
  EXPECT_EQ(refusal([&] {
    latticeSize<2>({ 1.0, 1.0 }, -1);
  }),
    "the number of seeds must not be negative, but is -1");
  EXPECT_EQ(refusal([&] {
    generateSeeds<2>(SeedPattern::Random, { 1.0, 0.0 }, 1, { point, 1 });
  }),
    "the sides of the seeds' box must be positive and finite, but side 1 is 0");
  for (double bad : { -1.0, 0.0, std::numeric_limits<double>::infinity(),
         std::numeric_limits<double>::quiet_NaN() })
  {
    EXPECT_THROW(generateSeeds<2>(SeedPattern::BlueNoise, { bad, 1.0 }, 1, { point, 1 }),
      std::invalid_argument);
    EXPECT_THROW(latticeSize<2>({ 1.0, bad }, 1), std::invalid_argument);
  }
  EXPECT_THROW(
    generateSeeds<2>(SeedPattern::Lattice, { 1.0, 1.0 }, 1, { point, 1 }), std::invalid_argument);
  EXPECT_EQ(refusal([&] {
    generateLattice<2>({ 2, -1 }, { point, 1 });
  }),
    "the seeds' grid must not have a negative size, but axis 1 has -1");
  EXPECT_THROW(generateJitteredLattice<2>({ -2, 1 }, 1, { point, 1 }), std::invalid_argument);
  const char* wrongCount = "there is memory for 1 seeds, but the grid has 6 cells";
  EXPECT_EQ(refusal([&] { generateLattice<2>({ 2, 3 }, { point, 1 }); }), wrongCount);
  EXPECT_EQ(refusal([&] { generateJitteredLattice<2>({ 2, 3 }, 1, { point, 1 }); }), wrongCount);
}

} // namespace
} // namespace RectifiedTransport
