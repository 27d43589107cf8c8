// SPDX-License-Identifier: BSD-3-Clause
// The tables of one tile after another, and the particles that are advected on them (TilePlan.h).
// On several ranks each of them makes the tables of some tiles, for the particles of all.
#ifndef RectifiedTransport_TileRun_h
#define RectifiedTransport_TileRun_h

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/Tiles/TileEntries.h"
#include "Core/Flow/Tiles/TileLanes.h"
#include "Core/Flow/Tiles/TilePlan.h"
#include "Core/Flow/Tiles/TileUnits.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Tables/GradedTables.h"
#include "Core/Tables/SharedDensity.h"
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

// How the particles of tiles are advected: from their seeds, their places at time 1 or the states
// of a map's records.
template <int Dimension>
struct TileStage
{
  FlowMapView<Dimension> Map;
  bool FromStates;
  bool StopsAtMap;
  bool IsKept; // where particles are that stay unresolved
  int Pass;    // of the kernel
};

template <int Dimension>
class TileRun
{
public:
  // Of the two densities one is given, the second where the progress has ranks, which then run this
  // together. `wide` is the job on the graded tables.
  TileRun(const DensityValues* density, const SharedDensity<Dimension>* sharedDensity,
    const GradedTables<Dimension>& graded, const TilePlan<Dimension>& plan,
    const FlowJob<Dimension>& wide, Counters& counters, Progress& progress)
    : Density(density)
    , OfRanks(sharedDensity)
    , Plan(plan)
    , Wide(wide)
    , Count(counters)
    , Work(progress)
    , Tile(graded.View(), graded.Scaling())
  {
  }

  // Whether a condition holds here or on another rank.
  bool HasAnyRank(bool condition) const
  {
    return !onAllRanks(this->OfRanks ? this->Work.Group() : nullptr, !condition);
  }

  // Makes the tables of each tile with items, and advects the particles that giveAll(item, give)
  // gives.
  template <class Item, class GiveAll>
  void Run(const ByTile<Item>& items, const TileStage<Dimension>& stage,
    PointSpan<Dimension> positions, ParticleMask& left, double begin, double end,
    const GiveAll& giveAll)
  {
    if (this->OfRanks)
    {
      this->RunTilesOfRanks(items, stage, positions, left, begin, end, giveAll);
      return;
    }
    for (std::int64_t tile = 0; tile < this->Plan.Count(); ++tile)
    {
      const std::int64_t first = items.Start(tile);
      const std::int64_t count = items.Start(tile + 1) - first;
      if (count == 0)
      {
        continue;
      }
      const double all = static_cast<double>(items.Count());
      const double from = begin + (end - begin) * static_cast<double>(first) / all;
      const double to = begin + (end - begin) * static_cast<double>(first + count) / all;
      GridSize<Dimension> low;
      GridSize<Dimension> high;
      this->Plan.FindCells(tile, low, high);
      this->BuildTile(*this->Density, low, high, from, to);
      const FlowJob<Dimension> job = this->TileJob(stage);
      this->Work.For(
        count, grain,
        [&](std::int64_t b, std::int64_t e) {
          TileLanes<Dimension> lanes(
            job, stage.Pass, stage.IsKept, positions, left, this->Count.Evaluations);
          for (std::int64_t item = first + b; item < first + e && !this->Work.ShouldStop(); ++item)
          {
            giveAll(
              items[item], [&](const double* values, std::int64_t index, std::int64_t particle) {
                std::copy_n(values, lanes.ValuesEach(), lanes.Next());
                lanes.Add(index, particle);
              });
          }
          lanes.Advance();
        },
        grain);
    }
  }

private:
  static constexpr std::int64_t grain = 32; // entries or blocks a range

  FlowJob<Dimension> TileJob(const TileStage<Dimension>& stage) const
  {
    FlowJob<Dimension> job = this->Wide;
    job.Tables = this->Tile.View();
    job.Sparse = false;
    job.Map = &stage.Map;
    job.FromStates = stage.FromStates;
    job.StopsAtMap = stage.StopsAtMap;
    return job;
  }

  // One of a chunk's stages, as shares of it.
  void BeginStage(double begin, double end, double share, std::int64_t units = 1)
  {
    this->Work.BeginStage(begin + (end - begin) * share, units);
  }

  void BuildTile(const DensityValues& density, const GridSize<Dimension>& low,
    const GridSize<Dimension>& high, double from, double to)
  {
    constexpr double partOfTables = 0.1;
    this->BeginStage(from, to, partOfTables, high[Dimension - 1] - low[Dimension - 1]);
    this->Tile.Build(density, low, high, this->Work);
    this->BeginStage(from, to, 1.0);
  }

  // Particles that are sent to the rank that has their tile.
  struct Sent
  {
    std::vector<double> Values;
    std::vector<std::int64_t> Index;
    std::vector<std::int64_t> Particle;
  };

  // In rounds: in each, every rank has the tables of one tile at most, gets the particles of all
  // ranks that are in it, part by part, and sends back where they end.
  template <class Item, class GiveAll>
  void RunTilesOfRanks(const ByTile<Item>& items, const TileStage<Dimension>& stage,
    PointSpan<Dimension> positions, ParticleMask& left, double begin, double end,
    const GiveAll& giveAll)
  {
    const Ranks& ranks = *this->Work.Group();
    const std::vector<std::vector<TileUnit>> units = this->AssignTiles(items, ranks);
    std::size_t rounds = 0;
    for (const std::vector<TileUnit>& those : units)
    {
      rounds = std::max(rounds, those.size());
    }
    // Bounds what one rank may receive at a time.
    constexpr std::int64_t mostReceived = std::int64_t{ 1 } << 21;
    constexpr std::int64_t leastSent = std::int64_t{ 1 } << 12;
    const auto most = static_cast<std::size_t>(std::max(leastSent, mostReceived / ranks.Count()));
    for (std::size_t round = 0; round < rounds; ++round)
    {
      const double all = static_cast<double>(rounds);
      this->MakeTileOfRound(units[static_cast<std::size_t>(ranks.Own())], round,
        begin + (end - begin) * static_cast<double>(round) / all,
        begin + (end - begin) * static_cast<double>(round + 1) / all);
      std::vector<std::int64_t> next(units.size());
      std::vector<std::int64_t> last(units.size());
      for (std::size_t rank = 0; rank < units.size(); ++rank)
      {
        if (round < units[rank].size())
        {
          const TileUnit& unit = units[rank][round];
          const std::int64_t first = items.Start(unit.Tile);
          const std::int64_t count = items.Start(unit.Tile + 1) - first;
          next[rank] = first + unit.FirstOf(count);
          last[rank] = first + unit.EndOf(count);
        }
      }
      bool hasMore = true;
      while (this->HasAnyRank(hasMore))
      {
        hasMore = false;
        std::vector<Sent> sent(units.size());
        for (std::size_t rank = 0; rank < units.size(); ++rank)
        {
          Sent& those = sent[rank];
          const auto each =
            static_cast<std::size_t>(TileLanes<Dimension>::valuesOf(stage.FromStates));
          const auto give = [&](const double* values, std::int64_t index, std::int64_t particle) {
            those.Values.insert(those.Values.end(), values, values + each);
            those.Index.push_back(index);
            those.Particle.push_back(particle);
          };
          for (; next[rank] < last[rank] && those.Index.size() < most; ++next[rank])
          {
            giveAll(items[next[rank]], give);
          }
          hasMore = hasMore || next[rank] < last[rank];
        }
        this->ExchangeAndAdvect(stage, sent, positions, left, ranks);
      }
    }
  }

  template <class Item>
  std::vector<std::vector<TileUnit>> AssignTiles(
    const ByTile<Item>& items, const Ranks& ranks) const
  {
    std::vector<std::int64_t> counts(static_cast<std::size_t>(this->Plan.Count()));
    for (std::size_t tile = 0; tile < counts.size(); ++tile)
    {
      const auto number = static_cast<std::int64_t>(tile);
      counts[tile] = items.Start(number + 1) - items.Start(number);
    }
    std::vector<std::int64_t> all(counts.size());
    for (const Bytes& bytes : ranks.Gather(toBytes(counts)))
    {
      const auto theirs = fromBytes<std::int64_t>(bytes);
      for (std::size_t tile = 0; tile < all.size(); ++tile)
      {
        all[tile] += theirs[tile];
      }
    }
    // Measured: a cell of a tile's tables takes about 1/50 of the time of a particle.
    constexpr double cell = 0.02;
    const double particlesOfItem = std::is_integral_v<Item> ? 1 : BlockSize;
    return assignTiles(all,
      cell * numberOfCells<Dimension>(this->Plan.MostCells()) / particlesOfItem, ranks.Count());
  }

  void MakeTileOfRound(
    const std::vector<TileUnit>& units, std::size_t round, double begin, double end)
  {
    GridSize<Dimension> low{};
    GridSize<Dimension> high{};
    const bool hasTile = round < units.size();
    if (hasTile)
    {
      this->Plan.FindCells(units[round].Tile, low, high);
    }
    const auto values = this->OfRanks->Gather(low, high);
    if (hasTile)
    {
      this->BuildTile(*values, low, high, begin, end);
    }
  }

  void ExchangeAndAdvect(const TileStage<Dimension>& stage, std::vector<Sent>& sent,
    PointSpan<Dimension> positions, ParticleMask& left, const Ranks& ranks)
  {
    std::vector<Bytes> parts;
    for (Sent& those : sent)
    {
      parts.push_back(toBytes(those.Values));
      those.Values = {};
    }
    const std::vector<Bytes> ends =
      ranks.Exchange(this->AdvectReceived(stage, ranks.Exchange(std::move(parts))));
    for (std::size_t rank = 0; rank < sent.size(); ++rank)
    {
      const Sent& those = sent[rank];
      const std::size_t count = those.Index.size();
      const char* unresolved = ends[rank].data() + count * sizeof(double) * Dimension;
      for (std::size_t i = 0; i < count; ++i)
      {
        if (unresolved[i] == 0 || stage.IsKept)
        {
          std::memcpy(positions[those.Index[i]], ends[rank].data() + i * sizeof(double) * Dimension,
            sizeof(double) * Dimension);
        }
        if (unresolved[i] != 0)
        {
          left.Add(those.Particle[i]);
        }
      }
    }
  }

  // Of the particles that each rank sent, on this rank's tile: where they end, then a byte for each
  // that says whether it is unresolved.
  std::vector<Bytes> AdvectReceived(
    const TileStage<Dimension>& stage, const std::vector<Bytes>& received)
  {
    const int each = TileLanes<Dimension>::valuesOf(stage.FromStates);
    std::vector<Bytes> replies;
    for (const Bytes& bytes : received)
    {
      const std::vector<double> values = fromBytes<double>(bytes);
      const auto count = static_cast<std::int64_t>(values.size()) / each;
      std::vector<double> ends(static_cast<std::size_t>(count * Dimension));
      ParticleMask unresolved(count);
      const PointSpan<Dimension> places(ends.data(), count);
      constexpr std::int64_t particles = grain * BlockSize;
      const FlowJob<Dimension> job = this->TileJob(stage);
      this->Work.For(
        count, particles,
        [&](std::int64_t first, std::int64_t last) {
          TileLanes<Dimension> lanes(
            job, stage.Pass, true, places, unresolved, this->Count.Evaluations);
          for (std::int64_t i = first; i < last && !this->Work.ShouldStop(); ++i)
          {
            std::copy_n(values.data() + i * each, each, lanes.Next());
            lanes.Add(i, i);
          }
          lanes.Advance();
        },
        particles);
      Bytes reply = toBytes(ends);
      for (std::int64_t i = 0; i < count; ++i)
      {
        reply.push_back(unresolved.Has(i) ? 1 : 0);
      }
      replies.push_back(std::move(reply));
    }
    return replies;
  }

  const DensityValues* const Density;
  const SharedDensity<Dimension>* const OfRanks;
  const TilePlan<Dimension>& Plan;
  const FlowJob<Dimension>& Wide;
  Counters& Count;
  Progress& Work;
  TileTables<Dimension> Tile;
};

} // namespace RectifiedTransport

#endif
