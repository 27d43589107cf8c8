// SPDX-License-Identifier: BSD-3-Clause
// Particles that visit the ranks which have the tables of their tile, in one round.
#ifndef RectifiedTransport_TileExchange_h
#define RectifiedTransport_TileExchange_h

#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Flow/Tiles/TileBins.h"
#include "Core/Flow/Tiles/TileSchedule.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace RectifiedTransport
{

// Particles leave in several exchanges, as a rank may receive few at a time. All ranks make the
// same number of exchanges, which the schedule gives. A particle travels as its values alone, and
// its reply comes back in the same order: which particle it is stays noted here.
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

} // namespace RectifiedTransport

#endif
