// SPDX-License-Identifier: BSD-3-Clause
// The quantile and the largest of errors, of one rank and of several.
#include "Core/Quality/BlockErrors.h"

#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Ranks.h"

#include "TestDensities.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

std::vector<double> someErrors(std::size_t count)
{
  std::mt19937_64 engine(count);
  std::vector<double> errors(count);
  std::generate(errors.begin(), errors.end(), [&]() { return uniformNumber(engine); });
  return errors;
}

TEST(BlockErrors, AsSorted)
{
  for (const std::size_t count : { 1, 2, 500, 999, 1000, 1001, 1999, 2000, 2001, 30000 })
  {
    SCOPED_TRACE(count);
    const std::vector<double> errors = someErrors(count);
    std::vector<double> sorted = errors;
    std::sort(sorted.begin(), sorted.end());
    const BlockErrors found = largestErrors(errors, SoloRanks::Get());
    EXPECT_EQ(found.Quantile, sorted[count * 999 / 1000]);
    EXPECT_EQ(found.Largest, sorted.back());
  }
}

TEST(BlockErrors, OfNoBlocks)
{
  const BlockErrors found = largestErrors({}, SoloRanks::Get());
  EXPECT_TRUE(std::isnan(found.Quantile));
  EXPECT_TRUE(std::isnan(found.Largest));
  EXPECT_TRUE(largestOf({}, 5, SoloRanks::Get()).empty());
}

// Also where the last rank has none.
TEST(BlockErrors, OnRanks)
{
  const std::vector<double> errors = someErrors(12345);
  const BlockErrors alone = largestErrors(errors, SoloRanks::Get());
  for (const int count : { 2, 3, 7 })
  {
    runOnRanks(count, [&](const Ranks& ranks) {
      const RankShare own(12345, count - 1, std::min(ranks.Own(), count - 2));
      const auto first = errors.begin() + own.First;
      const bool isLast = ranks.Own() == count - 1;
      const BlockErrors found = largestErrors(
        isLast ? std::vector<double>() : std::vector<double>(first, first + own.Count), ranks);
      EXPECT_EQ(found.Quantile, alone.Quantile);
      EXPECT_EQ(found.Largest, alone.Largest);
    });
  }
}

} // namespace
} // namespace RectifiedTransport
