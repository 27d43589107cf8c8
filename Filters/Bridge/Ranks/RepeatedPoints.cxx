// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/RepeatedPoints.h"

#include "Bridge/Points/GhostFlags.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// The bits of the coordinates, or the global id.
using Identity = std::array<std::uint64_t, 3>;

struct Found
{
  Identity Point;
  std::size_t Rank;
  std::size_t Number; // among those of the rank
};

Identity identityOf(vtkPointSet* points, vtkIdType i, vtkDataArray* ids)
{
  Identity identity{};
  if (ids)
  {
    identity[0] = static_cast<std::uint64_t>(ids->GetVariantValue(i).ToTypeInt64());
    return identity;
  }
  double place[3];
  points->GetPoint(i, place);
  std::memcpy(identity.data(), place, sizeof place);
  return identity;
}

bool connectsPoints(vtkPointSet* set)
{
  bool connects = false;
  for (vtkIdType cell = 0; cell < set->GetNumberOfCells() && !connects; ++cell)
  {
    const int type = set->GetCellType(cell);
    connects = type != VTK_EMPTY_CELL && type != VTK_VERTEX && type != VTK_POLY_VERTEX;
  }
  return connects;
}

// Which rank compares a point with those of all.
std::size_t comparerOf(const Identity& identity, int ranks)
{
  std::uint64_t hash = 0;
  for (const std::uint64_t word : identity)
  {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash % static_cast<std::uint64_t>(ranks));
}

// Of the points that each rank sent, those that a lower one sent, too.
std::vector<std::vector<unsigned char>> compare(const std::vector<std::vector<Identity>>& points)
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
    lowest = i > 0 && all[i].Point == all[i - 1].Point ? lowest : all[i].Rank;
    repeated[all[i].Rank][all[i].Number] = all[i].Rank > lowest ? 1 : 0;
  }
  return repeated;
}

} // namespace

std::vector<unsigned char> repeatedPoints(
  vtkPointSet* own, const CountedPoints& counted, const Ranks& ranks)
{
  if (onAllRanks(ranks, !connectsPoints(own)))
  {
    return {};
  }
  vtkDataArray* ids = own->GetPointData()->GetGlobalIds();
  ids = onAllRanks(ranks, ids || counted.Count() == 0) ? ids : nullptr;
  std::vector<std::vector<Identity>> given(static_cast<std::size_t>(ranks.Count()));
  std::vector<std::size_t> comparers;
  for (std::int64_t i = 0; i < counted.Count(); ++i)
  {
    const Identity identity = identityOf(own, static_cast<vtkIdType>(counted.Point(i)), ids);
    comparers.push_back(comparerOf(identity, ranks.Count()));
    given[comparers.back()].push_back(identity);
  }
  const std::vector<std::vector<unsigned char>> answers =
    exchangeValues(ranks, compare(exchangeValues(ranks, std::move(given))));
  std::vector<unsigned char> repeated;
  std::vector<std::size_t> taken(answers.size());
  for (const std::size_t comparer : comparers)
  {
    repeated.push_back(answers[comparer][taken[comparer]++]);
  }
  return repeated;
}

} // namespace RectifiedTransport
