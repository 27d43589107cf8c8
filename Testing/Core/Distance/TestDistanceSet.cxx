// SPDX-License-Identifier: BSD-3-Clause
// All pairs of densities: whatever their order, on several ranks, and what is kept of them.
#include "Core/Distance/DistanceSet.h"
#include "Core/Parallel/Executor.h"
#include "TestDensities.h"
#include "TestGrid.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// A bell at a place of the unit square, over a little of everything.
TestDensity<2> bellAt(double x, std::int64_t side = 32)
{
  return sampleDensity<2>(evenSize<2>(side), [x](const Point<2>& p) {
    const double square = (p[0] - x) * (p[0] - x) + (p[1] - 0.5) * (p[1] - 0.5);
    return 1e-6 + std::exp(-square / 0.005);
  });
}

struct Sample
{
  std::uint64_t Name;
  TestDensity<2> Density;
};

std::vector<DistancePair> findAll(DistanceSet& set, DistanceMethod method,
  const std::vector<Sample>& samples, const Context& context = Context())
{
  set.Begin(method);
  for (const Sample& sample : samples)
  {
    const double side = 1.0 / static_cast<double>(sample.Density.Size[0]); // of the unit square
    const ImageGrid grid = makeGrid<2>(sample.Density.Size, { side, side, 1.0 });
    const double* values = sample.Density.Values.data();
    if (set.Add({ sample.Name }, grid, { values, [](const double*) {} }, context))
    {
      set.MakeMaps(context);
    }
  }
  if (set.LacksMaps())
  {
    EXPECT_GT(set.MemoryForMaps(), 8.0 * set.CellsOfMaps());
    set.MakeMaps(context);
  }
  return set.Find(context);
}

bool areSame(const DistancePair& a, const DistancePair& b)
{
  return a.Distance == b.Distance && a.Lower == b.Lower && a.Upper == b.Upper;
}

class DistanceSets : public testing::TestWithParam<DistanceMethod>
{
};

TEST_P(DistanceSets, AreOfPairsInAnyOrder)
{
  const Sample a{ 7, bellAt(0.3) };
  const Sample b{ 2, bellAt(0.5) };
  const Sample c{ 5, bellAt(0.7) };
  DistanceSet set;
  const auto found = findAll(set, GetParam(), { a, b, c }); // ab, ac, bc
  ASSERT_EQ(found.size(), 3);
  EXPECT_EQ(set.NumberOfSolutions(), 3);
  for (const DistancePair& pair : found)
  {
    EXPECT_LE(pair.Lower, pair.Upper);
    EXPECT_EQ(pair.Distance, GetParam() == DistanceMethod::Certified ? pair.Lower : pair.Upper);
  }
  EXPECT_NEAR(found[0].Upper * found[0].Upper, 0.04, 0.01);
  EXPECT_NEAR(found[1].Upper * found[1].Upper, 0.16, 0.02);
  EXPECT_NEAR(found[2].Lower * found[2].Lower, 0.04, 0.01);
  // Nothing is computed again.
  const auto other = findAll(set, GetParam(), { c, a, b }); // ca, cb, ab
  EXPECT_EQ(set.NumberOfSolutions(), 3);
  EXPECT_TRUE(areSame(other[0], found[1]) && areSame(other[1], found[2]));
  EXPECT_TRUE(areSame(other[2], found[0]));
  // A set in another order computes the same.
  DistanceSet again;
  const auto reverse = findAll(again, GetParam(), { c, b, a }); // cb, ca, ba
  EXPECT_TRUE(areSame(reverse[0], found[2]) && areSame(reverse[1], found[1]));
  EXPECT_TRUE(areSame(reverse[2], found[0]));
}

TEST_P(DistanceSets, KnowEqualDensities)
{
  const Sample a{ 7, bellAt(0.3) };
  const Sample b{ 2, bellAt(0.5) };
  DistanceSet set;
  const auto found = findAll(set, GetParam(), { a, b, a }); // ab, aa, ba
  EXPECT_TRUE(areSame(found[0], found[2]));
  EXPECT_NEAR(found[1].Upper * found[1].Upper, 0.0, 1e-6);
  EXPECT_EQ(set.NumberOfSolutions(), GetParam() == DistanceMethod::Certified ? 1 : 2);
  // What is not given is forgotten.
  findAll(set, GetParam(), { a });
  findAll(set, GetParam(), { a, b });
  EXPECT_EQ(set.NumberOfSolutions(), GetParam() == DistanceMethod::Certified ? 2 : 3);
}

TEST_P(DistanceSets, AreTheSameOnRanks)
{
  std::vector<Sample> samples;
  for (std::uint64_t i = 0; i < 5; ++i)
  {
    samples.push_back({ i * 7 % 5, bellAt(0.2 + 0.1 * static_cast<double>(i), 24) });
  }
  DistanceSet alone;
  const auto expected = findAll(alone, GetParam(), samples);
  runOnRanks(3, [&](const Ranks& ranks) {
    Context context;
    context.Group = &ranks;
    DistanceSet set;
    const auto found = findAll(set, GetParam(), samples, context);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      EXPECT_TRUE(areSame(found[i], expected[i])) << i;
    }
    EXPECT_EQ(set.NumberOfSolutions(), alone.NumberOfSolutions());
  });
}

INSTANTIATE_TEST_SUITE_P(Methods, DistanceSets,
  testing::Values(DistanceMethod::Linearized, DistanceMethod::Certified), [](const auto& method) {
    return method.param == DistanceMethod::Certified ? "Certified" : "Linearized";
  });

// Linearized takes grids of different sizes, and more densities than are mapped together.
TEST(DistanceSet, MapsManyDensities)
{
  std::vector<Sample> samples;
  for (std::uint64_t i = 0; i < 20; ++i)
  {
    samples.push_back({ i, bellAt(0.25 + 0.025 * static_cast<double>(i), i % 2 == 0 ? 16 : 20) });
  }
  DistanceSet set;
  const auto found = findAll(set, DistanceMethod::Linearized, samples);
  EXPECT_EQ(found.size(), 190);
  EXPECT_EQ(set.NumberOfSolutions(), 20);
  EXPECT_NEAR(found[18].Upper, 0.475, 0.03); // of the first and the last one
}

} // namespace
} // namespace RectifiedTransport
