// SPDX-License-Identifier: BSD-3-Clause
// Points that several ranks have.
#ifndef RectifiedTransport_DuplicatePoints_h
#define RectifiedTransport_DuplicatePoints_h

#include "Core/Parallel/RankExchange.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// What tells a point from others: the bits of its coordinates, or a number.
using PointIdentity = std::array<std::uint64_t, 3>;

// Which rank compares a point with those of all.
std::size_t comparerOf(const PointIdentity& identity, int ranks);

// Marks the points of each rank that a lower rank sent, too.
std::vector<std::vector<unsigned char>> findDuplicates(
  const std::vector<std::vector<PointIdentity>>& points);

// For each of `count` points of this rank, which identityOf(i) identifies, whether a lower rank has
// it, too. Collective.
template <class IdentityOf>
std::vector<unsigned char> duplicatePoints(
  std::int64_t count, const IdentityOf& identityOf, const Ranks& ranks)
{
  // Each point goes to the rank that compares it, and the answers come back in the same order.
  std::vector<std::vector<PointIdentity>> given(static_cast<std::size_t>(ranks.Count()));
  std::vector<std::size_t> comparers;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const PointIdentity identity = identityOf(i);
    comparers.push_back(comparerOf(identity, ranks.Count()));
    given[comparers.back()].push_back(identity);
  }
  const std::vector<std::vector<unsigned char>> answers =
    exchangeValues(ranks, findDuplicates(exchangeValues(ranks, std::move(given))));
  std::vector<unsigned char> repeated;
  std::vector<std::size_t> taken(answers.size());
  for (const std::size_t comparer : comparers)
  {
    repeated.push_back(answers[comparer][taken[comparer]++]);
  }
  return repeated;
}

} // namespace RectifiedTransport

#endif
