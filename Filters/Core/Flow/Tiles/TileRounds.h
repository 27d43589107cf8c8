// SPDX-License-Identifier: BSD-3-Clause
// The tables of one tile after another, and what is computed on them. On several ranks each of them
// makes the tables of some tiles, for its own particles and those of others.
#ifndef RectifiedTransport_TileRounds_h
#define RectifiedTransport_TileRounds_h

#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Flow/Tiles/GridTiles.h"
#include "Core/Flow/Tiles/TileBins.h"
#include "Core/Flow/Tiles/TileSchedule.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/Density.h"
#include "Core/Tables/GradedTables.h"
#include "Core/Tables/TileTables.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// Particles that visit the ranks which have the tables of their tile, in one round. Particles leave
// in several exchanges, as a rank may receive few at a time. All ranks make the same number of
// exchanges, which the schedule gives. A particle travels as its values alone, and its reply comes
// back in the same order: which particle it is stays noted here.
template <class Item>
class TileExchange
{
public:
  // Items are particles, or parts of blocks.
  static constexpr std::int64_t ParticlesOfItem = std::is_integral_v<Item> ? 1 : BlockSize;

  // Takes the items of this rank; `units` are those of all ranks.
  TileExchange(const TileBins<Item>& items, const std::vector<std::vector<TileUnit>>& units,
    std::size_t round, const Ranks& ranks)
    : Items(items)
    , Runs(units.size())
    // Bounds what one rank may receive at a time.
    , Most(std::max<std::int64_t>(
        1, (std::int64_t{ 1 } << 16) / ParticlesOfItem / static_cast<std::int64_t>(units.size())))
  {
    for (std::size_t rank = 0; rank < units.size(); ++rank)
    {
      if (round >= units[rank].size())
      {
        continue;
      }
      const TileUnit& unit = units[rank][round];
      // Items of this unit by the rank that they come from. The longest of all queues sets the
      // number of exchanges.
      std::vector<std::int64_t> counts(units.size());
      for (const TileVisit& visit : unit.Visits)
      {
        if (visit.From != static_cast<int>(rank))
        {
          std::int64_t& count = counts[static_cast<std::size_t>(visit.From)];
          count += visit.Count();
          this->Longest = std::max(this->Longest, count);
        }
        if (visit.From != static_cast<int>(rank) && visit.From == ranks.Own())
        {
          const std::int64_t start = items.Start(unit.Tile);
          this->Runs[rank].push_back({ start + visit.First, start + visit.End });
        }
      }
    }
  }

  // On all ranks alike.
  bool HaveMore() const { return this->Done < this->Longest; }

  // The next ones of a task (TileRounds.h), for each rank.
  template <class Task>
  std::vector<Bytes> Leave(const Task& task)
  {
    this->Places.assign(this->Runs.size(), {});
    std::vector<Bytes> parts(this->Runs.size());
    const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(task.ValuesEach());
    for (std::size_t rank = 0; rank < this->Runs.size(); ++rank)
    {
      Bytes& part = parts[rank];
      std::vector<Place>& places = this->Places[rank];
      const auto give = [&](const double* values, std::int64_t index, std::int64_t particle) {
        const std::size_t size = part.size();
        part.resize(size + bytes);
        std::memcpy(part.data() + size, values, bytes);
        places.push_back({ index, particle });
      };
      // Runs are taken in order, each as far as there is room.
      std::int64_t taken = 0;
      for (Run& run : this->Runs[rank])
      {
        for (; run.Next < run.End && taken < this->Most; ++run.Next, ++taken)
        {
          task.Give(this->Items[run.Next], give);
        }
      }
    }
    this->Done += this->Most;
    return parts;
  }

  // Lets the task take what came back for each: as many bytes for all.
  template <class Task>
  void Return(const std::vector<Bytes>& replies, Task& task) const
  {
    for (std::size_t rank = 0; rank < replies.size(); ++rank)
    {
      const std::vector<Place>& places = this->Places[rank];
      const char* reply = replies[rank].data();
      // Replies of a rank are as long as one another.
      const std::size_t each = places.empty() ? 0 : replies[rank].size() / places.size();
      for (const Place& place : places)
      {
        task.Take(reply, place.Index, place.Particle);
        reply += each;
      }
    }
  }

private:
  // Items [Next, End) that have not left yet.
  struct Run
  {
    std::int64_t Next;
    std::int64_t End;
  };
  struct Place
  {
    std::int64_t Index;    // in the positions
    std::int64_t Particle; // in the row of particles
  };

  const TileBins<Item>& Items;
  std::vector<std::vector<Run>> Runs; // runs of items, for each rank
  const std::int64_t Most;            // items at a time for a rank
  std::int64_t Longest = 0;           // items of a rank for another one
  std::int64_t Done = 0;
  std::vector<std::vector<Place>> Places; // places of those that are away
};

// The tables of one tile are held at a time: those of the next are made in the same memory.
template <int Dimension>
class TileRounds
{
public:
  // If the density is distributed, all members are collective.
  TileRounds(const DensitySource<Dimension>& density, const GradedTables<Dimension>& graded,
    const GridTiles<Dimension>& tiles, const Ranks& ranks)
    : Density(density)
    , Tiles(tiles)
    , Group(ranks)
    , Tile(graded.View(), graded.Scaling())
  {
  }

  // Whether a condition holds here or on another rank.
  bool HasAnyRank(bool condition) const
  {
    return this->Density.IsDistributed() ? !onAllRanks(this->Group, !condition) : condition;
  }

  // The tables of the tile that is worked on.
  const TableView<Dimension>& Tables() const { return this->Tile.View(); }

  // Makes the tables of each tile with items, and lets `task` do what is to be done on them. A task
  // has
  //   Cell                            the time of a cell of the tables, in that of a particle
  //   Run(first, last, progress)      for the items of these numbers
  //   ValuesEach()                    how many doubles a particle has that visits another rank
  //   Give(item, give)                calls give(values, index, particle) for each of an item
  //   Serve(bytes, progress)          what visitors that came from one rank get: as many bytes each
  //   Take(bytes, index, particle)    of one that comes back
  template <class Item, class Task>
  void Run(const TileBins<Item>& items, Task&& task, Progress& progress)
  {
    if (this->Density.IsDistributed())
    {
      this->RunOnRanks(items, task, progress);
      return;
    }
    this->ReserveIf(items.Count() > 0);
    std::vector<double> counts;
    for (std::int64_t tile = 0; tile < this->Tiles.Count(); ++tile)
    {
      counts.push_back(static_cast<double>(items.Start(tile + 1) - items.Start(tile)));
    }
    Parts tiles(progress, counts);
    for (std::int64_t tile = 0; tile < this->Tiles.Count(); ++tile)
    {
      const std::int64_t first = items.Start(tile);
      const std::int64_t count = items.Start(tile + 1) - first;
      if (count == 0)
      {
        continue;
      }
      Stages stages = stagesOf(tiles[tile]);
      this->MakeTile(tile, stages["tables"]);
      task.Run(first, first + count, stages["items"]);
    }
  }

private:
  static constexpr std::int64_t none = -1; // a number of a tile

  void ReserveIf(bool isNeeded)
  {
    if (isNeeded)
    {
      this->Tile.Reserve(this->Tiles.MostCells());
    }
  }

  // The shares of a tile's time, measured at a particle a cell.
  static Stages stagesOf(Progress& tile) { return { tile, { { "tables", 1 }, { "items", 9 } } }; }

  // In rounds: in each, every rank has the tables of one tile at most, for its own particles and
  // those of others that visit it, which are sent back.
  template <class Item, class Task>
  void RunOnRanks(const TileBins<Item>& items, Task& task, Progress& progress)
  {
    const Ranks& ranks = this->Group;
    // The same on all ranks, which compute it from the same counts.
    const std::vector<std::vector<TileUnit>> units = this->Schedule(items, Task::Cell, ranks);
    const auto own = static_cast<std::size_t>(ranks.Own());
    this->ReserveIf(!units[own].empty());
    // There are as many rounds as the rank with the most tiles needs. Ranks that are done only take
    // part in the collective calls.
    std::size_t rounds = 0;
    for (const std::vector<TileUnit>& those : units)
    {
      rounds = std::max(rounds, those.size());
    }
    Parts each(progress, static_cast<std::int64_t>(rounds));
    for (std::size_t round = 0; round < rounds; ++round)
    {
      Stages stages = stagesOf(each[static_cast<std::int64_t>(round)]);
      const bool hasTile = round < units[own].size();
      // Collective, also for ranks without a tile: each holds a part of the density.
      this->MakeTile(hasTile ? units[own][round].Tile : none, stages["tables"]);
      Progress& work = stages["items"];
      if (hasTile)
      {
        const std::int64_t start = items.Start(units[own][round].Tile);
        // Own particles first, which are not sent.
        for (const TileVisit& visit : units[own][round].Visits)
        {
          if (visit.From == ranks.Own())
          {
            task.Run(start + visit.First, start + visit.End, work);
          }
        }
      }
      // Particles of other ranks, in parts that bound the memory: out, through the kernels there,
      // and back.
      TileExchange<Item> visitors(items, units, round, ranks);
      while (visitors.HaveMore())
      {
        std::vector<Bytes> parts = ranks.Exchange(visitors.Leave(task));
        for (Bytes& part : parts)
        {
          part = task.Process(std::move(part), work);
        }
        visitors.Return(ranks.Exchange(std::move(parts)), task);
      }
    }
  }

  // The tiles of every rank, from the numbers of items that all have in each: one gather. A tile's
  // tables cost as much as those of its largest possible size, in items.
  template <class Item>
  std::vector<std::vector<TileUnit>> Schedule(
    const TileBins<Item>& items, double cell, const Ranks& ranks) const
  {
    // This rank's items of each tile, and those of all ranks.
    std::vector<TileCount> own;
    for (std::int64_t tile = 0; tile < this->Tiles.Count(); ++tile)
    {
      const std::int64_t count = items.Start(tile + 1) - items.Start(tile);
      if (count > 0)
      {
        own.push_back({ tile, count });
      }
    }
    std::vector<std::vector<TileCount>> all;
    for (const Bytes& bytes : ranks.Gather(toBytes(own)))
    {
      all.push_back(fromBytes<TileCount>(bytes));
    }
    const double particlesOfItem = TileExchange<Item>::ParticlesOfItem;
    return scheduleTiles(
      all, cell * numberOfCells<Dimension>(this->Tiles.MostCells()) / particlesOfItem);
  }

  // `none` where this rank needs none: others may need its part of the density.
  void MakeTile(std::int64_t tile, Progress& progress)
  {
    GridSize<Dimension> low{};
    GridSize<Dimension> high{};
    if (tile != none)
    {
      this->Tiles.FindCells(tile, low, high);
    }
    const auto values = this->Density.Part(low, high);
    if (tile != none)
    {
      this->Tile.Build(*values, low, high, progress);
    }
  }

  const DensitySource<Dimension> Density;
  const GridTiles<Dimension>& Tiles;
  const Ranks& Group;
  TileTables<Dimension> Tile;
};

} // namespace RectifiedTransport

#endif
