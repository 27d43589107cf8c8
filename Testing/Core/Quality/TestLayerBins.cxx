// SPDX-License-Identifier: BSD-3-Clause
// Each batch of layers gives the items that lie in it, as a search through all of them does.
#include "Core/Quality/LayerBins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

TEST(LayerBins, AsASearchThroughAll)
{
  std::mt19937_64 engine(3);
  constexpr std::int64_t layers = 50;
  std::vector<LayerSpan> spans;
  for (int i = 0; i < 200; ++i)
  {
    const auto first = static_cast<std::int64_t>(engine() % layers);
    spans.push_back({ first, first + 1 + static_cast<std::int64_t>(engine() % 9) });
  }
  LayerBins items(spans);
  // Batches may leave layers out.
  for (const LayerSpan& batch : { LayerSpan{ 2, 7 }, { 7, 8 }, { 15, 30 }, { 30, 60 } })
  {
    std::vector<std::int64_t> found = items.In(batch);
    std::sort(found.begin(), found.end());
    std::vector<std::int64_t> expected;
    for (std::size_t i = 0; i < spans.size(); ++i)
    {
      if (spans[i].First < batch.End && spans[i].End > batch.First)
      {
        expected.push_back(static_cast<std::int64_t>(i));
      }
    }
    EXPECT_EQ(found, expected);
    EXPECT_FALSE(found.empty());
  }
}

} // namespace
} // namespace RectifiedTransport
