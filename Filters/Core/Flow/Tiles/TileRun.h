// SPDX-License-Identifier: BSD-3-Clause
// The tables of one tile after another, and the particles that are advected on them (TilePlan.h).
// On several ranks each of them makes the tables of some tiles, for its own particles and those of
// others.
#ifndef RectifiedTransport_TileRun_h
#define RectifiedTransport_TileRun_h

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/Tiles/TileEntries.h"
#include "Core/Flow/Tiles/TileLanes.h"
#include "Core/Flow/Tiles/TilePlan.h"
#include "Core/Flow/Tiles/TileSchedule.h"
#include "Core/Flow/Tiles/TileVisitors.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Tables/GradedTables.h"
#include "Core/Tables/SharedDensity.h"
#include "Core/Tables/TileTables.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
      this->AdvectItems(items, first, first + count, stage, positions, left, giveAll);
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

  // Advects the particles of the items [first, last).
  template <class Item, class GiveAll>
  void AdvectItems(const ByTile<Item>& items, std::int64_t first, std::int64_t last,
    const TileStage<Dimension>& stage, PointSpan<Dimension> positions, ParticleMask& left,
    const GiveAll& giveAll)
  {
    const FlowJob<Dimension> job = this->TileJob(stage);
    this->Work.For(
      last - first, grain,
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

  // In rounds: in each, every rank has the tables of one tile at most, for its own particles and
  // those of others that visit it, which are sent back.
  template <class Item, class GiveAll>
  void RunTilesOfRanks(const ByTile<Item>& items, const TileStage<Dimension>& stage,
    PointSpan<Dimension> positions, ParticleMask& left, double begin, double end,
    const GiveAll& giveAll)
  {
    const Ranks& ranks = *this->Work.Group();
    const std::vector<std::vector<TileUnit>> units = this->Schedule(items, ranks);
    const auto own = static_cast<std::size_t>(ranks.Own());
    std::size_t rounds = 0;
    for (const std::vector<TileUnit>& those : units)
    {
      rounds = std::max(rounds, those.size());
    }
    for (std::size_t round = 0; round < rounds; ++round)
    {
      const double each = (end - begin) / static_cast<double>(rounds);
      const double from = begin + each * static_cast<double>(round);
      const bool hasTile = round < units[own].size();
      this->MakeTile(hasTile ? &units[own][round] : nullptr, from, from + each);
      if (hasTile)
      {
        const std::int64_t start = items.Start(units[own][round].Tile);
        for (const TileVisit& visit : units[own][round].Visits)
        {
          if (visit.From == ranks.Own())
          {
            this->AdvectItems(
              items, start + visit.First, start + visit.End, stage, positions, left, giveAll);
          }
        }
      }
      TileVisitors<Dimension, Item> visitors(items, units, round, ranks);
      while (visitors.HaveMore())
      {
        const int values = TileLanes<Dimension>::valuesOf(stage.FromStates);
        std::vector<Bytes> received = ranks.Exchange(visitors.Leave(values, giveAll));
        std::vector<Bytes> ends = this->AdvectReceived(stage, std::move(received));
        visitors.Return(ranks.Exchange(std::move(ends)), stage.IsKept, positions, left);
      }
    }
  }

  template <class Item>
  std::vector<std::vector<TileUnit>> Schedule(const ByTile<Item>& items, const Ranks& ranks) const
  {
    std::vector<TileCount> own;
    for (std::int64_t tile = 0; tile < this->Plan.Count(); ++tile)
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
    // Measured: a cell of a tile's tables takes about 1/50 of the time of a particle.
    constexpr double cell = 0.02;
    const double particlesOfItem = TileVisitors<Dimension, Item>::ParticlesOfItem;
    return scheduleTiles(
      all, cell * numberOfCells<Dimension>(this->Plan.MostCells()) / particlesOfItem);
  }

  // nullptr where this rank needs none: others may need its part of the density.
  void MakeTile(const TileUnit* unit, double from, double to)
  {
    GridSize<Dimension> low{};
    GridSize<Dimension> high{};
    if (unit)
    {
      this->Plan.FindCells(unit->Tile, low, high);
    }
    const auto values = this->OfRanks->Gather(low, high);
    if (unit)
    {
      this->BuildTile(*values, low, high, from, to);
    }
  }

  // Of the particles that each rank sent, on this rank's tile: where they end, then a byte for each
  // that says whether it is unresolved.
  std::vector<Bytes> AdvectReceived(
    const TileStage<Dimension>& stage, std::vector<Bytes> received)
  {
    const int each = TileLanes<Dimension>::valuesOf(stage.FromStates);
    std::vector<Bytes> replies;
    for (Bytes& bytes : received)
    {
      const std::vector<double> values = fromBytes<double>(bytes);
      bytes = {};
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
