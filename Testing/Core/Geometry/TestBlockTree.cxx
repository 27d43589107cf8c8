// SPDX-License-Identifier: BSD-3-Clause
// A tree over blocks finds what a loop over all of them finds.
#include "Core/Geometry/Trees/BlockTree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// Blocks along a bent line.
BlockTree<2> bentLine(std::int64_t blocks)
{
  BlockTree<2> tree(blocks);
  for (std::int64_t i = 0; i < blocks; ++i)
  {
    const double x = static_cast<double>(i);
    const double y = 10.0 * std::sin(0.2 * x);
    tree[i] = { { x, y }, { x + 1.5, y + 1.0 }, 1.0 + static_cast<double>(i % 3) };
  }
  tree.Update();
  return tree;
}

TEST(BlockTree, FindsWhatIsInReach)
{
  for (const std::int64_t blocks : { 0, 1, 2, 3, 37, 64 })
  {
    const BlockTree<2> tree = bentLine(blocks);
    for (double x = -5.0; x < 70.0; x += 3.0)
    {
      const BlockBounds<2> target{ { x, 2.0 }, { x + 2.0, 3.0 }, 0.5 };
      const auto isInReach = [&](const BlockBounds<2>& box) {
        return squaredGap<2>(box, target) < box.Largest + target.Largest;
      };
      std::vector<std::int64_t> expected;
      for (std::int64_t i = 0; i < blocks; ++i)
      {
        if (isInReach(tree[i]))
        {
          expected.push_back(i);
        }
      }
      std::vector<std::int64_t> found{ 7 };
      tree.Find(isInReach, found);
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(BlockTree, VisitsParentsFirst)
{
  std::vector<std::pair<std::int64_t, std::int64_t>> visited;
  BlockTree<2>(3).ForEach(
    [&](std::int64_t first, std::int64_t last) { visited.emplace_back(first, last); });
  const std::vector<std::pair<std::int64_t, std::int64_t>> expected{ { 0, 3 }, { 0, 1 }, { 1, 3 },
    { 1, 2 }, { 2, 3 } };
  EXPECT_EQ(visited, expected);
}

TEST(BlockTree, BoundsOfSeveralBlocks)
{
  const BlockTree<2> tree = bentLine(20);
  const BlockBounds<2> bounds = tree.BoundsOf(3, 6);
  EXPECT_EQ(bounds.Low[0], 3.0);
  EXPECT_EQ(bounds.High[0], 6.5);
  EXPECT_EQ(bounds.Largest, 3.0);
}

} // namespace
} // namespace RectifiedTransport
