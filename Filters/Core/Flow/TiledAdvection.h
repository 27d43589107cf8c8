// SPDX-License-Identifier: BSD-3-Clause
// An advection through tiles that are worked through one after another (TilePlan.h); on several
// ranks each of them makes the tables of some tiles, for the particles of all.
#ifndef RectifiedTransport_TiledAdvection_h
#define RectifiedTransport_TiledAdvection_h

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/NodeAdvance.h"
#include "Core/Flow/TileEntries.h"
#include "Core/Flow/TileLanes.h"
#include "Core/Flow/TilePlan.h"
#include "Core/Flow/TileUnits.h"
#include "Core/Parallel/LargeBuffer.h"
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

template <int Dimension>
class TiledAdvection
{
public:
  // Of the two densities one is given, the second where the progress has ranks, which then run this
  // together. The map may be null; it is of the plan's shape.
  TiledAdvection(const DensityValues* density, const SharedDensity<Dimension>* sharedDensity,
    const GradedTables<Dimension>& graded, const TilePlan<Dimension>& plan,
    const AdvectionJob<Dimension>& shared, const FlowMap<Dimension>* map, Counters& counters,
    Progress& progress)
    : Density(density)
    , OfRanks(sharedDensity)
    , Plan(plan)
    , Wide(shared.Job)
    , Count(counters)
    , Work(progress)
    , Tile(graded.View(), graded.Scaling())
    , Read(flowKernels().Read<Dimension>())
    , LastPass(shared.Job.Backward ? 0 : shared.LastPass())
  {
    this->Wide.Tables = graded.View();
    this->Wide.ShouldStop = [](void* clientData) {
      return static_cast<Progress*>(clientData)->ShouldStop();
    };
    this->Wide.ClientData = &progress;
    this->Wide.Sparse = true;
    for (std::int64_t step = 0; step < plan.Shape.Steps; ++step)
    {
      this->Weights.push_back(multistepWeights(step, plan.Shape.Steps));
    }
    if (map)
    {
      this->Map = map->View();
    }
    this->Map.Steps = plan.Shape.Steps;
    this->Map.Weights = this->Weights.data();
  }

  // As AdvectionRun::Advect, without times.
  template <class Source>
  void Run(Source&& source, PointSpan<Dimension> positions)
  {
    const std::int64_t all = source.Count();
    const double begin = this->Work.StageEnd();
    for (std::int64_t first = 0; this->HasAnyRank(first < all);)
    {
      const std::int64_t length = first < all ? source.Prepare(first) : 0;
      const auto stageAt = [&](std::int64_t done) {
        return begin +
          (1.0 - begin) * static_cast<double>(done) /
          static_cast<double>(std::max<std::int64_t>(1, all));
      };
      this->RunChunk(source, length, positions, stageAt(first), stageAt(first + length));
      first += length;
    }
    this->Work.BeginStage(1.0);
    this->Work.EndSlice(1);
  }

private:
  static constexpr std::int64_t grain = 32; // entries or blocks a range

  // Particles of one block that are in one tile.
  struct Entry
  {
    std::int64_t Block;
    std::uint64_t Particles;
    std::int64_t Tile;
  };

  // Whether a condition holds here or on another rank.
  bool HasAnyRank(bool condition) const
  {
    return this->OfRanks ? sumOverRanks<std::int64_t>(this->Work.Group(), condition ? 1 : 0) > 0
                         : condition;
  }

  bool HandsOverFromMap() const
  {
    return this->Map.LevelCount > 0 &&
      this->Map.Levels[this->Map.LevelCount - 1].HandOver == this->Plan.HandOver;
  }

  // One of a chunk's stages, as shares of it.
  void BeginStage(double begin, double end, double share, std::int64_t units = 1)
  {
    this->Work.BeginStage(begin + (end - begin) * share, units);
  }

  template <class Source>
  void RunChunk(const Source& source, std::int64_t length, PointSpan<Dimension> positions,
    double begin, double end)
  {
    constexpr double partOfMap = 0.1;
    constexpr double partOfTiles = 0.9;
    ParticleMask left(length);
    if (this->Wide.Backward || this->HandsOverFromMap())
    {
      this->BeginStage(begin, end, partOfMap);
      const ByTile<Entry> entries = this->FindTiles(source, length, left);
      const TileStage stage = this->StageOfEntries();
      this->RunTiles(entries, stage, positions, left, begin + partOfMap * (end - begin),
        begin + partOfTiles * (end - begin),
        [&](const Entry& entry, const auto& give) { giveEntry(source, entry, give); });
    }
    else
    {
      for (std::int64_t block = 0; block < left.Blocks(); ++block)
      {
        left.AddToBlock(block, blockMask(length - block * BlockSize));
      }
    }
    const double done = this->Work.StageEnd();
    for (int pass = 0; pass <= this->LastPass; ++pass)
    {
      const std::int64_t count = left.Count();
      const double passEnd = pass < this->LastPass ? 0.5 * (this->Work.StageEnd() + end) : end;
      ParticleMask next(length);
      this->RunPass(source, pass, left, count, positions, next, done, passEnd);
      std::swap(left, next);
      this->Count.Redone += pass == 0 && !this->Wide.Backward ? left.Count() : 0;
    }
    if (!this->Wide.Backward)
    {
      this->MoveToMass(source, left, positions);
    }
  }

  static std::uint64_t blockMask(std::int64_t particles)
  {
    return particles >= BlockSize ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << particles) - 1;
  }

  template <class Source>
  static int fillBlock(const Source& source, std::int64_t length, std::int64_t block,
    std::int64_t* index, double* seeds)
  {
    const auto count =
      static_cast<int>(std::min<std::int64_t>(BlockSize, length - block * BlockSize));
    source.Fill(block * BlockSize, count, index, seeds);
    return count;
  }

  // The entries of all particles, but those that the map does not serve: these are `left`.
  template <class Source>
  ByTile<Entry> FindTiles(const Source& source, std::int64_t length, ParticleMask& left)
  {
    const std::int64_t blocks = left.Blocks();
    std::vector<std::vector<Entry>> found(static_cast<std::size_t>((blocks + grain - 1) / grain));
    const auto find = [&](std::int64_t block, std::vector<Entry>& entries) {
      std::int64_t index[BlockSize];
      double places[BlockSize * Dimension];
      bool deferred[BlockSize] = {};
      const int count = fillBlock(source, length, block, index, places);
      if (!this->Wide.Backward)
      {
        double seeds[BlockSize * Dimension];
        std::copy_n(places, count * Dimension, seeds);
        this->Read(
          this->Wide, this->Map.Levels[this->Map.LevelCount - 1], seeds, count, places, deferred);
      }
      const std::size_t before = entries.size();
      for (int i = 0; i < count; ++i)
      {
        if (deferred[i])
        {
          left.Add(block * BlockSize + i);
          continue;
        }
        const std::int64_t tile = this->Plan.TileOf(places + i * Dimension);
        auto entry = std::find_if(entries.begin() + static_cast<std::ptrdiff_t>(before),
          entries.end(), [tile](const Entry& other) { return other.Tile == tile; });
        if (entry == entries.end())
        {
          entries.push_back({ block, 0, tile });
          entry = entries.end() - 1;
        }
        entry->Particles |= std::uint64_t{ 1 } << i;
      }
    };
    this->Work.For(
      blocks, grain,
      [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t block = begin; block < end && !this->Work.ShouldStop(); ++block)
        {
          find(block, found[static_cast<std::size_t>(block / grain)]);
        }
      },
      grain);
    return ByTile<Entry>(found, this->Plan.Count(), [](const Entry& entry) { return entry.Tile; });
  }

  // How the particles of tiles are advected: from their seeds, their places at time 1 or the states
  // of a map's records.
  struct TileStage
  {
    FlowMapView<Dimension> Map;
    bool FromStates;
    bool StopsAtMap;
    bool IsKept; // where particles are that stay unresolved
    int Pass;    // of the kernel
  };

  FlowJob<Dimension> TileJob(const TileStage& stage) const
  {
    FlowJob<Dimension> job = this->Wide;
    job.Tables = this->Tile.View();
    job.Sparse = false;
    job.Map = &stage.Map;
    job.FromStates = stage.FromStates;
    job.StopsAtMap = stage.StopsAtMap;
    return job;
  }

  TileStage StageOfEntries() const
  {
    const bool isBackward = this->Wide.Backward; // keeps those that the map gives no seed
    TileStage stage{ this->Map, false, isBackward, isBackward, 0 };
    if (isBackward && !this->HandsOverFromMap())
    {
      stage.Map.LevelCount = 1;
      stage.Map.Levels[0].HandOver = this->Plan.HandOver;
      stage.Map.Levels[0].Records = nullptr;
    }
    stage.Pass = -stage.Map.LevelCount;
    return stage;
  }

  // Calls give(values, index, particle) for each particle of an item of a tile.
  template <class Source, class Give>
  static void giveEntry(const Source& source, const Entry& entry, const Give& give)
  {
    std::int64_t index[BlockSize];
    double seeds[BlockSize * Dimension];
    // What is after its last particle in this tile is not used.
    const int count = BlockSize - __builtin_clzll(entry.Particles);
    source.Fill(entry.Block * BlockSize, count, index, seeds);
    for (int i = 0; i < count; ++i)
    {
      if ((entry.Particles >> i & 1) != 0)
      {
        give(seeds + i * Dimension, index[i], entry.Block * BlockSize + i);
      }
    }
  }

  // Makes the tables of each tile with items, and advects the particles that giveAll(item, give)
  // gives.
  template <class Item, class GiveAll>
  void RunTiles(const ByTile<Item>& items, const TileStage& stage, PointSpan<Dimension> positions,
    ParticleMask& left, double begin, double end, const GiveAll& giveAll)
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
  void RunTilesOfRanks(const ByTile<Item>& items, const TileStage& stage,
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
    const double particlesOfItem = std::is_same_v<Item, Entry> ? BlockSize : 1;
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

  void ExchangeAndAdvect(const TileStage& stage, std::vector<Sent>& sent,
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
  std::vector<Bytes> AdvectReceived(const TileStage& stage, const std::vector<Bytes>& received)
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

  // Particles of a pass that are taken to the hand-over by themselves.
  struct Extra
  {
    std::vector<std::int64_t> Particle;
    LargeBuffer<float> Records;
    std::vector<unsigned char> Troubled;
  };

  // Takes all that is in `given` from the seeds, with 2^pass times as many steps; what is still
  // unresolved is in `left` then.
  template <class Source>
  void RunPass(const Source& source, int pass, const ParticleMask& given, std::int64_t count,
    PointSpan<Dimension> positions, ParticleMask& left, double begin, double end)
  {
    const std::int64_t most = this->Plan.ExtraParticles();
    std::int64_t block = 0;
    for (std::int64_t done = 0; this->HasAnyRank(done < count);)
    {
      Extra extra;
      extra.Particle.reserve(static_cast<std::size_t>(std::min(most, count - done)));
      for (; block < given.Blocks(); ++block)
      {
        std::uint64_t word = given.Block(block);
        if (static_cast<std::int64_t>(extra.Particle.size()) + __builtin_popcountll(word) > most)
        {
          break;
        }
        for (; word != 0; word &= word - 1)
        {
          extra.Particle.push_back(block * BlockSize + __builtin_ctzll(word));
        }
      }
      const auto share = [&](std::int64_t particles) {
        return begin +
          (end - begin) * static_cast<double>(particles) /
          static_cast<double>(std::max<std::int64_t>(1, count));
      };
      const auto length = static_cast<std::int64_t>(extra.Particle.size());
      this->RunExtra(source, pass, extra, positions, left, share(done), share(done + length));
      done += length;
    }
  }

  template <class Source>
  void RunExtra(const Source& source, int pass, Extra& extra, PointSpan<Dimension> positions,
    ParticleMask& left, double begin, double end)
  {
    constexpr int forward = FlowMapLevel<Dimension>::ForwardRecord;
    constexpr int backward = FlowMapLevel<Dimension>::BackwardRecord;
    const bool isBackward = this->Wide.Backward;
    const int record = isBackward ? backward : forward;
    const auto count = static_cast<std::int64_t>(extra.Particle.size());
    extra.Records = LargeBuffer<float>(count * record);
    extra.Troubled.resize(static_cast<std::size_t>(count));

    FlowMapView<Dimension> map = this->Map;
    int parents = map.LevelCount - (this->HandsOverFromMap() ? 1 : 0);
    if (pass > 0)
    {
      parents = 0;
      map.Steps <<= pass;
      map.Weights = nullptr;
    }
    FlowMapLevel<Dimension> level{};
    level.HandOver = this->Plan.HandOver << pass;
    level.TimeLeft = static_cast<float>(this->Plan.TimeLeft);
    level.Records = extra.Records.data();
    FlowJob<Dimension> job = this->Wide;
    job.Map = &map;
    const double middle = isBackward ? end : begin + 0.5 * (end - begin);
    this->Work.BeginStage(middle);
    const auto particle = [&extra](std::int64_t number) {
      return extra.Particle[static_cast<std::size_t>(number)];
    };
    this->Count.Evaluations += NodeAdvance<Dimension>(job, level, this->Work)
                                 .Run(count, parents, extra.Troubled.data(),
                                   [&](const std::int64_t* numbers, int length, double* places) {
                                     for (int i = 0; i < length; ++i)
                                     {
                                       std::int64_t index = 0;
                                       double* place = places + i * Dimension;
                                       source.Fill(particle(numbers[i]), 1, &index, place);
                                       if (isBackward)
                                       {
                                         std::copy_n(positions[index], Dimension, place);
                                       }
                                     }
                                   });
    if (isBackward)
    {
      this->WriteSeeds(source, extra, positions);
      return;
    }
    // Those that met an empty box are redone, in the last pass from where they are all the same.
    map.Levels[0] = level;
    map.LevelCount = 1;
    std::vector<std::vector<std::int64_t>> numbers(1);
    numbers[0].reserve(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i)
    {
      if (extra.Troubled[static_cast<std::size_t>(i)] && pass < this->LastPass)
      {
        left.Add(particle(i));
      }
      else
      {
        numbers[0].push_back(i);
      }
    }
    const ByTile<std::int64_t> byTile(numbers, this->Plan.Count(), [&](std::int64_t number) {
      double place[Dimension];
      std::copy_n(level.Records + number * record, Dimension, place);
      return this->Plan.TileOf(place);
    });
    this->RunTiles(byTile, { map, true, false, pass == this->LastPass, -1 }, positions, left,
      middle, end, [&](std::int64_t number, const auto& give) {
        std::int64_t index = 0;
        double seed[Dimension];
        source.Fill(particle(number), 1, &index, seed);
        double state[TileLanes<Dimension>::StateSize];
        std::copy_n(level.Records + number * record, TileLanes<Dimension>::StateSize, state);
        give(state, index, particle(number));
      });
  }

  template <class Source>
  void WriteSeeds(const Source& source, const Extra& extra, PointSpan<Dimension> positions)
  {
    constexpr int record = FlowMapLevel<Dimension>::BackwardRecord;
    constexpr std::int64_t seedGrain = 4096;
    this->Work.Threads().For(static_cast<std::int64_t>(extra.Particle.size()), seedGrain,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i)
        {
          std::int64_t index = 0;
          double point[Dimension];
          source.Fill(extra.Particle[static_cast<std::size_t>(i)], 1, &index, point);
          for (int axis = 0; axis < Dimension; ++axis)
          {
            const auto size = static_cast<double>(this->Plan.Size[axis]);
            const double seed = extra.Records.data()[i * record + axis];
            positions[index][axis] = std::min(std::max(seed, 0.0), size);
          }
        }
      });
    this->Work.Check();
  }

  template <class Source>
  void MoveToMass(const Source& source, const ParticleMask& left, PointSpan<Dimension> positions)
  {
    FlowJob<Dimension> job = this->Wide;
    job.Output = positions.data();
    this->Work.Threads().For(left.Blocks(), 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t block = first; block < last && !this->Work.ShouldStop(); ++block)
      {
        for (std::uint64_t word = left.Block(block); word != 0; word &= word - 1)
        {
          std::int64_t index = 0;
          double seed[Dimension];
          source.Fill(block * BlockSize + __builtin_ctzll(word), 1, &index, seed);
          moveToMass<Dimension>(job, index, this->Count);
        }
      }
    });
    this->Work.Check();
  }

  const DensityValues* const Density;
  const SharedDensity<Dimension>* const OfRanks;
  const TilePlan<Dimension>& Plan;
  FlowJob<Dimension> Wide; // on the graded tables
  Counters& Count;
  Progress& Work;
  TileTables<Dimension> Tile;
  const ReadMap<Dimension> Read;
  const int LastPass;
  std::vector<StepWeights> Weights;
  FlowMapView<Dimension> Map;
};

} // namespace RectifiedTransport

#endif
