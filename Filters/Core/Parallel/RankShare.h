// SPDX-License-Identifier: BSD-3-Clause
// Each rank's share of items.
#ifndef RectifiedTransport_RankShare_h
#define RectifiedTransport_RankShare_h

#include "Core/Parallel/Ranks.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// [0, count) divided among the ranks as evenly as possible.
struct RankShare
{
  RankShare(std::int64_t count, int ranks, int rank)
    : First(count / ranks * rank + std::min<std::int64_t>(count % ranks, rank))
    , Count(count / ranks + (rank < count % ranks ? 1 : 0))
  {
  }
  RankShare(std::int64_t count, const Ranks& ranks)
    : RankShare(count, ranks.Count(), ranks.Own())
  {
  }

  // Which rank has an item of [0, count).
  static int Of(std::int64_t item, std::int64_t count, int ranks)
  {
    const std::int64_t each = count / ranks;
    const std::int64_t larger = count % ranks * (each + 1); // the items of the ranks with one more
    return static_cast<int>(
      item < larger ? item / (each + 1) : count % ranks + (item - larger) / each);
  }

  std::int64_t First;
  std::int64_t Count;
};

// The beginnings of the shares of all ranks and the end, for items of `each` values.
inline std::vector<std::int64_t> shareStarts(
  std::int64_t count, std::int64_t each, const Ranks& ranks)
{
  std::vector<std::int64_t> starts;
  for (int rank = 0; rank < ranks.Count(); ++rank)
  {
    starts.push_back(RankShare(count, ranks.Count(), rank).First * each);
  }
  starts.push_back(count * each);
  return starts;
}

} // namespace RectifiedTransport

#endif
