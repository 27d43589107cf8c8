// SPDX-License-Identifier: BSD-3-Clause
// Sums, shares and parts of arrays over ranks.
#include "Core/Parallel/Context.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/RankShare.h"

#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

TEST(Ranks, SharesFollowOneAnother)
{
  for (const std::int64_t count : { 0, 1, 2, 7, 64, 65 })
  {
    for (int ranks = 1; ranks < 6; ++ranks)
    {
      std::int64_t next = 0;
      for (int rank = 0; rank < ranks; ++rank)
      {
        const RankShare share(count, ranks, rank);
        EXPECT_EQ(share.First, next);
        EXPECT_LE(share.Count, count / ranks + 1);
        EXPECT_GE(share.Count, count / ranks);
        next += share.Count;
      }
      EXPECT_EQ(next, count);
    }
  }
}

// More than one message a rank, and ranks without a part.
TEST(Ranks, PartsOfAnArrayReachAll)
{
  for (const int count : { 1, 2, 3, 5 })
  {
    for (const std::int64_t length : { std::int64_t{ 3 }, std::int64_t{ 5000003 } })
    {
      runOnRanks(count, [&](const Ranks& ranks) {
        const std::vector<std::int64_t> starts = shareStarts(length, 1, ranks);
        std::vector<std::int64_t> values(static_cast<std::size_t>(length), -1);
        const auto own = static_cast<std::size_t>(ranks.Own());
        for (std::int64_t i = starts[own]; i < starts[own + 1]; ++i)
        {
          values[static_cast<std::size_t>(i)] = 3 * i;
        }
        gatherParts(ranks, starts, values.data());
        for (std::int64_t i = 0; i < length; ++i)
        {
          ASSERT_EQ(values[static_cast<std::size_t>(i)], 3 * i);
        }
      });
    }
  }
}

TEST(Ranks, AgreeAndAdd)
{
  runOnRanks(3, [](const Ranks& ranks) {
    EXPECT_EQ(sumOverRanks<std::int64_t>(ranks, 1 << ranks.Own()), 7);
    EXPECT_FALSE(onAllRanks(ranks, ranks.Own() != 1));
    EXPECT_TRUE(onAllRanks(ranks, true));
  });
}

TEST(Ranks, PlacesOnMachinesCountThoseBefore)
{
  const std::vector<std::string> machines{ "a", "b", "a", "ab", "b", "a" };
  const std::vector<int> expected{ 0, 0, 1, 0, 1, 2 };
  runOnRanks(6, [&](const Ranks& ranks) {
    const auto own = static_cast<std::size_t>(ranks.Own());
    EXPECT_EQ(placeOnMachine(ranks, machines[own]), expected[own]);
  });
}

// The ranks of a context that is given none.
TEST(Ranks, OneGivesToItself)
{
  const Context context;
  const Ranks& solo = *context.Group;
  EXPECT_EQ(solo.Count(), 1);
  EXPECT_FALSE(solo.AreSeveral());
  EXPECT_TRUE(solo.IsFirst());
  EXPECT_EQ(solo.Gather({ 'a', 'b' }), (std::vector<Bytes>{ { 'a', 'b' } }));
  EXPECT_EQ(solo.Exchange({ { 'c' } }), (std::vector<Bytes>{ { 'c' } }));
  EXPECT_EQ(sumOverRanks<std::int64_t>(solo, 5), 5);
  EXPECT_FALSE(onAllRanks(solo, false));
  EXPECT_TRUE(onAllRanks(solo, true));
}

TEST(Ranks, OneThatFailsEndsAll)
{
  EXPECT_THROW(runOnRanks(3,
                 [](const Ranks& ranks) {
                   if (ranks.Own() == 1)
                   {
                     throw std::runtime_error("failed");
                   }
                   sumOverRanks<std::int64_t>(ranks, 1);
                   FAIL() << "the exchange of a rank that has failed";
                 }),
    std::runtime_error);
}

} // namespace
} // namespace RectifiedTransport
