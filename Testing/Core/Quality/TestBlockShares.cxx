// SPDX-License-Identifier: BSD-3-Clause
// Blocks cover the grid once, and their shares are those of their cells: in one piece and in turns.
#include "Core/Quality/BlockShares.h"

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankShare.h"

#include "RecordingContext.h"
#include "TestDensities.h"
#include "TestTiles.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
namespace
{

TEST(BlockShares, BlocksCoverTheGrid)
{
  const GridSize<3> size{ 7, 4, 5 };
  const GridBlocks<3> blocks(size, 3);
  EXPECT_EQ(blocks.Count(), 3 * 2 * 2);
  std::vector<int> covered(static_cast<std::size_t>(cellCount<3>(size)));
  for (std::int64_t block = 0; block < 12; ++block)
  {
    const GridBox<3> box = blocks.Box(block);
    std::int64_t cells = 0;
    for (std::size_t i = 0; i < covered.size(); ++i)
    {
      const GridSize<3> cell = cellAt<3>(static_cast<std::int64_t>(i), size);
      bool isIn = true;
      Point<3> middle;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        isIn = isIn && cell[axis] >= box.Low[axis] && cell[axis] < box.High[axis];
        middle[axis] = static_cast<double>(cell[axis]) + 0.5;
      }
      EXPECT_EQ(blocks.At(middle) == block, isIn);
      covered[i] += isIn ? 1 : 0;
      cells += isIn ? 1 : 0;
    }
    EXPECT_EQ(box.Cells(), static_cast<double>(cells));
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), static_cast<int>(covered.size()));
  EXPECT_EQ(blocks.At({ 7.0, 4.0, 5.0 }), 11); // the far corner
}

template <int Dimension>
std::vector<double> sharesOf(
  const RectifiedFlow<Dimension>& flow, const GridBlocks<Dimension>& blocks, const Context& context)
{
  const RankShare own(static_cast<std::int64_t>(blocks.Count()), *context.Group);
  std::vector<double> shares(static_cast<std::size_t>(own.Count));
  Progress progress(context);
  findBlockShares<Dimension>(flow, blocks, own.First, own.Count, shares.data(), progress);
  return shares;
}

// A grid of more cells than a rank takes at a time, in blocks of more and of fewer cells than that.
template <int Dimension>
void checkShares(const GridSize<Dimension>& size, std::int64_t blockSize)
{
  SCOPED_TRACE(blockSize);
  const GridBlocks<Dimension> blocks(size, blockSize);
  auto density = uniformDensity<Dimension>(size);
  std::vector<double> sums(static_cast<std::size_t>(blocks.Count()));
  double all = 0.0;
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(static_cast<std::int64_t>(i), size);
    Point<Dimension> middle;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      middle[axis] = static_cast<double>(cell[axis]) + 0.5;
    }
    density.Values[i] = static_cast<double>(1 + i % 1013);
    sums[static_cast<std::size_t>(blocks.At(middle))] += density.Values[i];
    all += density.Values[i];
  }
  TileLimits limits;
  limits.GradedNodes = 200000;
  const TiledRun<Dimension> tiled(density, limits);
  const std::vector<double> expected = sharesOf<Dimension>(tiled.Flow, blocks, Context());
  for (std::size_t block = 0; block < sums.size(); ++block)
  {
    EXPECT_NEAR(expected[block], sums[block] / all, 1e-12);
  }
  std::vector<double> found(expected.size());
  runOnRanks(3, [&](const Ranks& ranks) {
    const RankFlow<Dimension> run(density, ranks, limits); // reads no cells that it did not ask for
    const RankShare own(static_cast<std::int64_t>(found.size()), ranks);
    const std::vector<double> shares = sharesOf<Dimension>(run.Flow, blocks, run.RankContext());
    std::copy(shares.begin(), shares.end(), found.begin() + own.First);
  });
  EXPECT_EQ(found, expected);
}

TEST(BlockShares, InTurns)
{
  checkShares<2>({ 2311, 2003 }, 4000); // one block, in parts
  checkShares<2>({ 2311, 2003 }, 2200); // a large block and a narrow one
  checkShares<2>({ 2311, 2003 }, 70);
  checkShares<3>({ 173, 181, 157 }, 177);
  checkShares<3>({ 173, 181, 157 }, 16);
}

} // namespace
} // namespace RectifiedTransport
