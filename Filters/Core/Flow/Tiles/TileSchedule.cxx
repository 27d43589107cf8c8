// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Tiles/TileSchedule.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

namespace
{

std::int64_t sumOf(const std::vector<TileVisit>& visits)
{
  return std::accumulate(visits.begin(), visits.end(), std::int64_t{ 0 },
    [](std::int64_t sum, const TileVisit& visit) { return sum + visit.Count(); });
}

// A greedy schedule: each rank keeps its own items as far as their tables pay, and the rest goes to
// the ranks of least cost, tiles with the most items first. Costs are in the time of an item. All
// ties are broken by numbers, so that every rank computes the same schedule.
class Scheduling
{
public:
  // Sets the bounds; ranks have no items yet.
  Scheduling(const std::vector<std::vector<TileCount>>& counts, double costOfTables)
    : CostOfTables(costOfTables)
    , Units(counts.size())
  {
    constexpr double uneven = 1.125; // a rank's items over its part of all
    // A visit costs about a fourth of what tables of its own would for that many items.
    constexpr double worthwhile = 4.0;
    std::int64_t all = 0;
    for (const std::vector<TileCount>& those : counts)
    {
      for (const TileCount& count : those)
      {
        all += count.Items;
      }
    }
    // Fewer items than that in a tile visit another rank. A rank takes no more than Most items, so
    // that none is left to work when the others are done.
    this->Least = std::max<std::int64_t>(1, static_cast<std::int64_t>(worthwhile * costOfTables));
    this->Most = std::max(this->Least,
      static_cast<std::int64_t>(
        uneven * static_cast<double>(all) / static_cast<double>(counts.size())));
  }

  // First what ranks keep, in the order of the ranks, then all that moves.
  void Add(const std::vector<std::vector<TileCount>>& counts)
  {
    for (std::size_t rank = 0; rank < counts.size(); ++rank)
    {
      // The tiles of the most items first: their tables pay most, before the rank has its part.
      std::vector<TileCount> own = counts[rank];
      std::stable_sort(own.begin(), own.end(),
        [](const TileCount& a, const TileCount& b) { return a.Items > b.Items; });
      for (const TileCount& count : own)
      {
        this->AddOwn(rank, count);
      }
    }
    // Negative, for the most items first, and equal numbers by tile.
    std::vector<std::pair<std::int64_t, std::int64_t>> order; // items and tiles
    for (const auto& [tile, visits] : this->Moving)
    {
      order.emplace_back(-sumOf(visits), tile);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [items, tile] : order)
    {
      for (const TileVisit& visit : this->Moving[tile])
      {
        this->AddMoving(tile, visit);
      }
    }
  }

  // The units of each rank, the largest first.
  std::vector<std::vector<TileUnit>> Sorted() const
  {
    std::vector<std::vector<TileUnit>> sorted;
    for (const Rank& rank : this->Units)
    {
      sorted.emplace_back();
      for (const auto& [tile, visits] : rank.TileBins)
      {
        sorted.back().push_back({ tile, visits });
      }
      // The largest first: rounds in which ranks wait for each other are then of about the same
      // length.
      std::stable_sort(sorted.back().begin(), sorted.back().end(),
        [](const TileUnit& a, const TileUnit& b) { return a.Count() > b.Count(); });
    }
    return sorted;
  }

private:
  // What a rank has so far.
  struct Rank
  {
    std::map<std::int64_t, std::vector<TileVisit>> TileBins;
    std::int64_t Items = 0;
    double Cost = 0.0; // with that of the tables
  };

  // Gives a rank as many of its items in a tile as it may take, or none if they are too few for
  // tables. The others move.
  void AddOwn(std::size_t rank, const TileCount& count)
  {
    std::int64_t own = std::min(count.Items, this->Most - this->Units[rank].Items);
    own = own < this->Least ? 0 : own;
    const int from = static_cast<int>(rank);
    if (own > 0)
    {
      this->Give(rank, count.Tile, { from, 0, own });
    }
    if (own < count.Items)
    {
      this->Moving[count.Tile].push_back({ from, own, count.Items });
    }
  }

  // Divided where no rank may take all of it.
  void AddMoving(std::int64_t tile, TileVisit visit)
  {
    while (visit.Count() > 0)
    {
      // Each part has Least items or more, so that the loop ends even if all ranks have enough.
      const std::size_t rank = this->Choose(tile, static_cast<std::size_t>(visit.From));
      const std::int64_t taken =
        std::min(visit.Count(), std::max(this->Least, this->Most - this->Units[rank].Items));
      this->Give(rank, tile, { visit.From, visit.First, visit.First + taken });
      visit.First += taken;
    }
  }

  // One that makes the tile's tables and may take more, the one of least cost; else that of least
  // cost of all, or the visitor's own where that costs no more.
  std::size_t Choose(std::int64_t tile, std::size_t from) const
  {
    const auto cheaper = [this](std::size_t a, std::size_t b) {
      return this->Units[a].Cost < this->Units[b].Cost;
    };
    // `best` has the tables already; `least` is the cheapest of all.
    std::size_t best = this->Units.size();
    std::size_t least = 0;
    for (std::size_t rank = 0; rank < this->Units.size(); ++rank)
    {
      least = cheaper(rank, least) ? rank : least;
      const bool serves =
        this->Units[rank].TileBins.count(tile) > 0 && this->Units[rank].Items < this->Most;
      if (serves && (best == this->Units.size() || cheaper(rank, best)))
      {
        best = rank;
      }
    }
    if (best < this->Units.size())
    {
      return best;
    }
    return this->Units[from].Cost <= this->Units[least].Cost ? from : least;
  }

  // The first items of a tile also cost its tables.
  void Give(std::size_t rank, std::int64_t tile, const TileVisit& visit)
  {
    Rank& given = this->Units[rank];
    std::vector<TileVisit>& visits = given.TileBins[tile];
    given.Cost += static_cast<double>(visit.Count()) + (visits.empty() ? this->CostOfTables : 0.0);
    given.Items += visit.Count();
    visits.push_back(visit);
  }

  const double CostOfTables;
  std::vector<Rank> Units;
  std::map<std::int64_t, std::vector<TileVisit>> Moving; // by tile
  std::int64_t Most = 0;                                 // items of a rank
  std::int64_t Least = 0;                                // of a part of them in a tile
};

} // namespace

std::int64_t TileUnit::Count() const
{
  return sumOf(this->Visits);
}

std::vector<std::vector<TileUnit>> scheduleTiles(
  const std::vector<std::vector<TileCount>>& counts, double costOfTables)
{
  Scheduling scheduling(counts, costOfTables);
  scheduling.Add(counts);
  return scheduling.Sorted();
}

} // namespace RectifiedTransport
