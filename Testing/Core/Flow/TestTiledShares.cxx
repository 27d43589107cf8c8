// SPDX-License-Identifier: BSD-3-Clause
// Boxes of given shares by tiles, against those by whole tables. The limits make the tables of
// small densities as coarse, and their tiles as many, as those of large ones.
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Flow/Tiles/TiledShares.h"
#include "Core/Parallel/Ranks.h"

#include "../../MemoryLimit.h"
#include "TestDensities.h"
#include "TestDimensions.h"
#include "TestFlow.h"
#include "TestRefusal.h"
#include "TestTiles.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// Sides of boxes: alike, and of an image whose spacings differ.
template <int Dimension>
std::vector<Point<Dimension>> aspects()
{
  Point<Dimension> uneven = evenPoint<Dimension>(1.0);
  uneven[0] = 0.4;
  uneven[Dimension - 1] = 3.0;
  return { evenPoint<Dimension>(1.0), uneven };
}

template <class T>
using BoxesByTiles = DimensionTest<T>;
TYPED_TEST_SUITE(BoxesByTiles, PlaneAndSpace);

// Of each tile, so that the boxes that leave it are wide enough for the graded tables.
TYPED_TEST(BoxesByTiles, TilesReachFarEnough)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> strides = gradedStrides<D>(manyTilesSize<D>(), manyTiles<D>());
  EXPECT_GT(*std::max_element(strides.begin(), strides.end()), 1);
  for (const Point<D>& aspect : aspects<D>())
  {
    const GridTiles<D> tiles = tilesForShares<D>(manyTilesSize<D>(), aspect, manyTiles<D>());
    EXPECT_GT(tiles.Count(), 1);
    double half = 0.0;
    for (int axis = 0; axis < D; ++axis)
    {
      half = std::max(half,
        strides[axis] > 1 ? 0.5 * gradedRatio * static_cast<double>(strides[axis]) / aspect[axis]
                          : 0.0);
    }
    for (int axis = 0; axis < D; ++axis)
    {
      EXPECT_GE(static_cast<double>(tiles.Halo()[axis]),
        std::min(half * aspect[axis], static_cast<double>(manyTilesSize<D>()[axis])));
    }
  }
}

// Also where graded tables have all nodes.
TYPED_TEST(BoxesByTiles, HaveAllOfAnAxisWithoutLength)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = randomCells<D>(manyTilesSize<D>());
  const RectifiedFlow<D> whole = makeFlow(density);
  const Points<D> centres = randomPoints<D>(density.Size, 20);
  const std::vector<double> shares(centres.size(), 0.01);
  Point<D> aspect = evenPoint<D>(1.0);
  aspect[D - 1] = std::numeric_limits<double>::infinity();
  TileLimits all = manyTiles<D>();
  all.GradedNodes = 10000000;
  for (const TileLimits& limits : { manyTiles<D>(), all })
  {
    EXPECT_EQ(tilesForShares<D>(density.Size, aspect, limits).Halo()[D - 1], density.Size[D - 1]);
    const TiledRun<D> run(density, limits);
    for (std::size_t i = 0; i < centres.size(); ++i)
    {
      std::vector<double> measure(1);
      run.Flow.MeasuresOfShares({ centres[i].data(), 1 }, aspect, shares.data(), measure.data());
      const double expected = whole.MeasureOfShare(centres[i], aspect, shares[i]);
      EXPECT_NEAR(measure[0], expected, 0.01 * expected);
    }
  }
}

// The measures of boxes of mixed shares.
template <int Dimension>
std::vector<double> measuresOf(const RectifiedFlow<Dimension>& flow,
  const Points<Dimension>& centres, const Point<Dimension>& aspect,
  const std::vector<double>& shares, const Context& context = Context())
{
  std::vector<double> measures = shares; // in the same memory
  flow.MeasuresOfShares(centres, aspect, measures.data(), measures.data(), context);
  return measures;
}

TYPED_TEST(BoxesByTiles, AreThoseOfWholeTables)
{
  constexpr int D = TypeParam::value;
  for (const TestDensity<D>& density : { randomCells<D>(manyTilesSize<D>()),
         twoGaussians<D>(manyTilesSize<D>()), discWithHole<D>(manyTilesSize<D>()) })
  {
    const RectifiedFlow<D> whole = makeFlow(density);
    const TiledRun<D> run(density, manyTiles<D>());
    const Points<D> centres = randomPoints<D>(density.Size, 400);
    for (const Point<D>& aspect : aspects<D>())
    {
      int narrow = 0;
      int wide = 0;
      double mean = 0.0;
      std::vector<double> shares(centres.size());
      for (std::size_t i = 0; i < shares.size(); ++i)
      {
        shares[i] = std::pow(10.0, -0.5 * static_cast<double>(i % 12)) * 0.4;
      }
      const std::vector<double> expected = measuresOf<D>(whole, centres, aspect, shares);
      const std::vector<double> found = measuresOf<D>(run.Flow, centres, aspect, shares);
      for (std::size_t i = 0; i < shares.size(); ++i)
      {
        EXPECT_EQ(expected[i], whole.MeasureOfShare(centres[i], aspect, shares[i]));
        const double error = std::abs(found[i] / expected[i] - 1.0);
        ++(error < 1e-6 ? narrow : wide);
        mean += error / static_cast<double>(shares.size());
        EXPECT_LT(error, 0.05) << i;
      }
      EXPECT_LT(mean, 2e-3);
      EXPECT_GT(narrow, 150);
      EXPECT_GT(wide, 10);
    }
  }
}

TYPED_TEST(BoxesByTiles, OfNothingAndOfAll)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = randomCells<D>(manyTilesSize<D>());
  const TiledRun<D> run(density, manyTiles<D>());
  Points<D> centres = randomPoints<D>(density.Size, 3);
  centres[1].fill(0.0);
  const std::vector<double> found =
    measuresOf<D>(run.Flow, centres, evenPoint<D>(1.0), { 0.0, 1.0, -1.0 });
  EXPECT_EQ(found[0], 0.0);
  EXPECT_NEAR(found[1] / static_cast<double>(cellCount<D>(density.Size)), 1.0, 1e-12);
  EXPECT_EQ(found[2], 0.0);
  EXPECT_TRUE(measuresOf<D>(run.Flow, {}, evenPoint<D>(1.0), {}).empty());
}

// Shares of the boxes by ranks: even, most on one, none on some.
TYPED_TEST(BoxesByTiles, OnRanksHaveTheSameBits)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = randomCells<D>(manyTilesSize<D>());
  const TiledRun<D> alone(density, manyTiles<D>());
  const Points<D> centres = randomPoints<D>(density.Size, 3000);
  std::vector<double> shares(centres.size());
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    shares[i] = i % 7 == 0 ? 0.01 : i % 11 == 0 ? 0.0 : 1.0 / static_cast<double>(shares.size());
  }
  const Point<D> aspect = aspects<D>()[1];
  const std::vector<double> expected = measuresOf<D>(alone.Flow, centres, aspect, shares);
  for (const int count : { 2, 3, 5 })
  {
    for (const double power : { 1.0, 4.0 })
    {
      std::vector<double> found(shares.size());
      runOnRanks(count, [&](const Ranks& ranks) {
        const RankFlow<D> run(density, ranks, manyTiles<D>());
        const auto start = [&](int rank) {
          const double part = static_cast<double>(rank) / static_cast<double>(count);
          return static_cast<std::ptrdiff_t>(
            static_cast<double>(shares.size()) * std::pow(part, power));
        };
        const std::ptrdiff_t first = start(ranks.Own());
        const std::ptrdiff_t last = start(ranks.Own() + 1);
        const std::vector<double> own =
          measuresOf<D>(run.Flow, { centres.begin() + first, centres.begin() + last }, aspect,
            { shares.begin() + first, shares.begin() + last }, run.RankContext());
        std::copy(own.begin(), own.end(), found.begin() + first);
      });
      EXPECT_EQ(found, expected) << count << " ranks";
    }
  }
}

#ifdef HAS_MEMORY_LIMIT
TYPED_TEST(BoxesByTiles, TakeTheMemoryForetold)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 100 }, { 2500, 2000 }, { 160, 150, 140 });
  const TestDensity<D> density = discWithHole<D>(size);
  const TileLimits limits = tileLimits<D>(1500000, 800000, D == 3 ? 60 : 300);
  const SerialExecutor serial;
  const Context context(serial);
  const Points<D> centres = randomPoints<D>(size, 1500000);
  const std::vector<double> shares(centres.size(), 1e-6);
  std::vector<double> measures(centres.size());
  const Point<D> aspect = evenPoint<D>(1.0);
  const auto run = [&](double bytes) {
    const MemoryLimit limit(static_cast<std::int64_t>(bytes));
    const TiledRun<D> tiled(density, limits, context);
    tiled.Flow.MeasuresOfShares(centres, aspect, shares.data(), measures.data(), context);
  };
  const double bytes = RectifiedFlow<D>::TiledSharesMemoryFor(
    size, aspect, static_cast<double>(centres.size()), limits);
  constexpr double small = 24e6; // the program's own, and what lies between blocks
  EXPECT_NO_THROW(run(bytes + small)) << bytes;
  EXPECT_THROW(run(0.5 * bytes - small), std::bad_alloc) << bytes;
}
#endif

TEST(TiledSharesOfALine, Refuse)
{
  EXPECT_NE(refusal([]() {
    RectifiedFlow<1>::TiledSharesMemoryFor({ 1000 }, { 1.0 }, 10.0);
  }).find("tiles"),
    std::string::npos);
}

} // namespace
} // namespace RectifiedTransport
