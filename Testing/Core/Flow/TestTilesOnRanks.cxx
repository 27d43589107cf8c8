// SPDX-License-Identifier: BSD-3-Clause
// Flows with tiles that several ranks compute together have the bits of one rank.
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parallel/RankShare.h"

#include "TestDimensions.h"
#include "TestFlow.h"
#include "TestTiles.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// Each rank's share of the seeds, moved by move(flow, seeds, context); together.
template <int Dimension, class Shares, class Move>
Points<Dimension> runShares(const TestDensity<Dimension>& density, const Points<Dimension>& seeds,
  int count, const Shares& shares, const Move& move)
{
  Points<Dimension> all(seeds.size());
  runOnRanks(count, [&](const Ranks& ranks) {
    const RankFlow<Dimension> run(density, ranks, manyTiles<Dimension>());
    const std::int64_t first = shares(ranks.Own());
    const std::int64_t last = shares(ranks.Own() + 1);
    Points<Dimension> own(seeds.begin() + first, seeds.begin() + last);
    move(run.Flow, own, run.RankContext());
    std::copy(own.begin(), own.end(), all.begin() + first);
  });
  return all;
}

template <class T>
using TilesOnRanks = DimensionTest<T>;
TYPED_TEST_SUITE(TilesOnRanks, PlaneAndSpace);

// Seeds in equal shares, and all of them on one rank; densities with empty regions, too, whose
// particles are redone.
TYPED_TEST(TilesOnRanks, PointsHaveTheBitsOfOneRank)
{
  constexpr int D = TypeParam::value;
  for (const TestDensity<D>& density :
    { twoGaussians<D>(manyTilesSize<D>()), discWithHole<D>(manyTilesSize<D>()) })
  {
    const DensityArray<D, double> source = density.Source();
    const RectifiedFlow<D> alone(source, FlowTables::Tiled, Context(), manyTiles<D>());
    const Points<D> seeds = randomPoints<D>(density.Size, 4001);
    const auto end = static_cast<std::int64_t>(seeds.size());
    for (const FlowMaps maps : OffAndOn)
    {
      const FlowOptions options = with(maps, steps(32));
      const Points<D> forward = runForward(alone, seeds, options);
      const Points<D> backward = runBackward(alone, seeds, options);
      for (const int count : { 1, 2, 3 })
      {
        SCOPED_TRACE(nameOf(maps) + " on " + std::to_string(count));
        const auto equal = [&](int rank) {
          return rank < count ? RankShare(end, count, rank).First : end;
        };
        const auto onLast = [&](int rank) { return rank < count ? std::int64_t{ 0 } : end; };
        const auto moveForward = [&](const RectifiedFlow<D>& flow, Points<D>& own,
                                   const Context& context) {
          flow.Forward(own, own, options, context);
        };
        const auto moveBackward = [&](const RectifiedFlow<D>& flow, Points<D>& own,
                                    const Context& context) {
          flow.Backward(own, own, options, context);
        };
        EXPECT_TRUE(sameBits<D>(forward, runShares<D>(density, seeds, count, equal, moveForward)));
        EXPECT_TRUE(sameBits<D>(forward, runShares<D>(density, seeds, count, onLast, moveForward)));
        EXPECT_TRUE(
          sameBits<D>(backward, runShares<D>(density, seeds, count, equal, moveBackward)));
      }
    }
  }
}

// Layers of a lattice, with so many samples in a tile that ranks make its tables for their own.
TYPED_TEST(TilesOnRanks, LatticesHaveTheBitsOfOneRank)
{
  constexpr int D = TypeParam::value;
  constexpr int last = D - 1;
  const TestDensity<D> density = twoGaussians<D>(manyTilesSize<D>());
  const DensityArray<D, double> source = density.Source();
  const RectifiedFlow<D> alone(source, FlowTables::Tiled, Context(), manyTiles<D>());
  const GridSize<D> lattice = evenSize<D>(D == 3 ? 80 : 150);
  Points<D> expected(cellCount<D>(lattice));
  const FlowOptions options = with(FlowMaps::Auto, steps(32));
  alone.Forward(FlowSeeds<D>::Lattice(lattice), expected, options);
  for (const int count : { 2, 3 })
  {
    Points<D> all(expected.size());
    runOnRanks(count, [&](const Ranks& ranks) {
      const RankFlow<D> run(density, ranks, manyTiles<D>());
      const RankShare share(lattice[last], ranks);
      LatticePart<D> part = LatticePart<D>::WholeOf(lattice);
      part.Low[last] = share.First;
      part.Cells[last] = share.Count;
      const std::int64_t layer = part.Count() / share.Count;
      run.Flow.Forward(FlowSeeds<D>::Lattice(lattice, { part, part }),
        { all.data()->data() + D * share.First * layer, part.Count() }, options, run.RankContext());
    });
    EXPECT_TRUE(sameBits<D>(expected, all));
  }
}

// The second time the map is kept on one of the ranks alone: all make it again.
TYPED_TEST(TilesOnRanks, AgreeOnCachedMaps)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = twoGaussians<D>(manyTilesSize<D>());
  const Points<D> seeds = randomPoints<D>(density.Size, 500);
  const FlowOptions options = with(FlowMaps::On, steps(32));
  const FlowOptions others = with(FlowMaps::On, steps(40));
  const DensityArray<D, double> source = density.Source();
  const RectifiedFlow<D> alone(source, FlowTables::Tiled, Context(), manyTiles<D>());
  const Points<D> expected = runForward(alone, seeds, options);
  std::atomic<int> same{ 0 };
  runOnRanks(2, [&](const Ranks& ranks) {
    const RankFlow<D> first(density, ranks, manyTiles<D>());
    const RankFlow<D> second(density, ranks, manyTiles<D>());
    Points<D> found = runForward(first.Flow, seeds, options, first.RankContext());
    // Flows whose histories differ by rank, as after a failure.
    runForward(second.Flow, seeds, others, second.RankContext());
    const RankFlow<D>& mixed = ranks.Own() == 0 ? first : second;
    found = runForward(mixed.Flow, seeds, options, mixed.RankContext());
    same += sameBits<D>(expected, found) ? 1 : 0;
  });
  EXPECT_EQ(same, 2);
}

} // namespace
} // namespace RectifiedTransport
