// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Distributed/DuplicatePoints.h"

#include "Core/Parallel/BytesHash.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

struct Found
{
  PointIdentity Point;
  std::size_t Rank;
  std::size_t Number; // among those of the rank
};

} // namespace

// By a hash, so that each rank compares about as many points as others.
std::size_t comparerOf(const PointIdentity& identity, int ranks)
{
  std::uint64_t hash = 0;
  for (const std::uint64_t word : identity)
  {
    hash = mixWord(hash, word);
  }
  return static_cast<std::size_t>(hash % static_cast<std::uint64_t>(ranks));
}

// Equal points are neighbours after sorting, the one of the lowest rank first.
std::vector<std::vector<unsigned char>> findDuplicates(
  const std::vector<std::vector<PointIdentity>>& points)
{
  std::vector<Found> all;
  std::vector<std::vector<unsigned char>> repeated;
  for (std::size_t rank = 0; rank < points.size(); ++rank)
  {
    for (std::size_t i = 0; i < points[rank].size(); ++i)
    {
      all.push_back({ points[rank][i], rank, i });
    }
    repeated.emplace_back(points[rank].size());
  }
  std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) {
    return a.Point != b.Point ? a.Point < b.Point : a.Rank < b.Rank;
  });
  std::size_t lowest = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    // The rank of the first of equal points.
    lowest = i > 0 && all[i].Point == all[i - 1].Point ? lowest : all[i].Rank;
    repeated[all[i].Rank][all[i].Number] = all[i].Rank > lowest ? 1 : 0;
  }
  return repeated;
}

} // namespace RectifiedTransport
