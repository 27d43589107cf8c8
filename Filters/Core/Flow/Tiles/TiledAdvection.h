// SPDX-License-Identifier: BSD-3-Clause
// An advection through tiles that are worked through one after another (TilePlan.h).
//
// Forwards, particles whose cell of the finest lattice is good are sorted by the tile of their
// place at the hand-over. Tile by tile they start from the lattice again, and are finished. The
// others, and those that end unresolved, are taken to the hand-over one by one, like nodes of a
// lattice, on the graded tables, and are finished tile by tile from their states there (pass 0).
// What is then unresolved starts again from its seed with 2, 4, ... 32 times as many steps (the
// other passes). What still ends in an empty cell is moved to the nearest mass.
//
// Backwards, tiles come first, from time 1 to the hand-over, where the lattice gives the seed.
// Where it does not, or there is none, particles go on to time 0 on the graded tables.
#ifndef RectifiedTransport_TiledAdvection_h
#define RectifiedTransport_TiledAdvection_h

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/NodeAdvance.h"
#include "Core/Flow/Particles/ParticleSource.h"
#include "Core/Flow/Tiles/TileBins.h"
#include "Core/Flow/Tiles/TilePlan.h"
#include "Core/Flow/Tiles/TileRounds.h"
#include "Core/Flow/Tiles/TileTask.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Tables/GradedTables.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// Particles are noted by their number in the row that the source has, in words of a bit each
// (ParticleMask). Seeds are made again whenever they are needed, rather than kept.
template <int Dimension>
class TiledAdvection
{
public:
  // The map may be null; it is of the plan's shape.
  TiledAdvection(const DensitySource<Dimension>& density, const GradedTables<Dimension>& graded,
    const TilePlan<Dimension>& plan, const AdvectionJob<Dimension>& shared,
    const FlowMap<Dimension>* map, Counters& counters, Progress& progress)
    : Plan(plan)
    , Wide(shared.Job)
    , Count(counters)
    , Work(progress)
    , Rounds(density, graded, plan.Tiles, progress.Group())
    , Read(flowKernels<Dimension>().Read)
    , LastPass(shared.Job.Backward ? 0 : shared.LastPass())
    , Weights(multistepWeightsOf(plan.Shape.Steps, plan.Shape.Direction))
  {
    this->Wide.Tables = graded.View();
    this->Wide.Sparse = true;
    if (map)
    {
      this->Map = map->View();
    }
    this->Map.Steps = plan.Shape.Steps;
    this->Map.Weights = this->Weights.data();
  }

  // As AdvectionRun::Advect, without times.
  void Run(ParticleSource<Dimension>& source, PointSpan<Dimension> positions)
  {
    const std::int64_t all = source.Count();
    Parts chunks(this->Work, source.Chunks());
    std::int64_t chunk = 0;
    for (std::int64_t first = 0; this->Rounds.HasAnyRank(first < all); ++chunk)
    {
      const std::int64_t length = first < all ? source.Prepare(first) : 0;
      // Other ranks may have more.
      this->RunChunk(source, length, positions, chunks[std::min(chunk, source.Chunks() - 1)]);
      first += length;
    }
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

  // Whether the finest lattice ends at the hand-over, so that particles start from it there.
  bool HandsOverFromMap() const
  {
    return this->Map.LevelCount > 0 &&
      this->Map.Levels[this->Map.LevelCount - 1].HandOver == this->Plan.HandOver;
  }

  void RunChunk(const ParticleSource<Dimension>& source, std::int64_t length,
    PointSpan<Dimension> positions, Progress& progress)
  {
    const bool hasEntries = this->Wide.Backward || this->HandsOverFromMap();
    Stages stages(progress,
      { { "map", hasEntries ? 1.0 : 0.0 }, { "tiles", hasEntries ? 8.0 : 0.0 }, { "passes", 1 } });
    ParticleMask left(length);
    if (hasEntries)
    {
      // Which particles are in which tile, then all tiles that have any.
      const TileBins<Entry> entries = this->FindTiles(source, length, left, stages["map"]);
      // The kernels take them from the map forwards, to it backwards, in the pass of its finest
      // level.
      const FlowMapView<Dimension> map = this->MapOfEntries();
      FlowJob<Dimension> job = this->JobOfTiles(map);
      job.StopsAtMap = job.Backward; // keeps those that the map gives no seed
      const TileStage<Dimension> stage{ job, -map.LevelCount, job.Backward, positions, left,
        this->Count };
      const EntryParticles giveEntry{ source };
      this->Rounds.Run(
        entries, TileTask(stage, this->Rounds.Tables(), entries, giveEntry), stages["tiles"]);
    }
    else
    {
      for (std::int64_t block = 0; block < left.Blocks(); ++block)
      {
        // Without a map that ends at the hand-over, all particles go the long way.
        left.AddToBlock(block, blockMask(length - block * BlockSize));
      }
    }
    // Each has half of the weight of the last one: nobody knows how many particles that leaves.
    std::vector<double> weights;
    for (int pass = 0; pass <= this->LastPass; ++pass)
    {
      weights.push_back(1.0 / (1 << pass));
    }
    Parts passes(stages["passes"], weights);
    for (int pass = 0; pass <= this->LastPass; ++pass)
    {
      const std::int64_t count = left.Count();
      ParticleMask next(length);
      this->RunPass(source, pass, left, count, positions, next, passes[pass]);
      std::swap(left, next);
      this->Count.Redone += pass == 0 && !this->Wide.Backward ? left.Count() : 0;
    }
    if (!this->Wide.Backward)
    {
      this->MoveToMass(source, left, positions);
    }
  }

  // The particles of a block, if there are so many left.
  static std::uint64_t blockMask(std::int64_t particles)
  {
    return particles >= BlockSize ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << particles) - 1;
  }

  static int fillBlock(const ParticleSource<Dimension>& source, std::int64_t length,
    std::int64_t block, std::int64_t* index, double* seeds)
  {
    const auto count =
      static_cast<int>(std::min<std::int64_t>(BlockSize, length - block * BlockSize));
    source.Fill(block * BlockSize, count, index, seeds);
    return count;
  }

  // The entries of all particles, but those that the map does not serve: these are `left`.
  TileBins<Entry> FindTiles(const ParticleSource<Dimension>& source, std::int64_t length,
    ParticleMask& left, Progress& progress)
  {
    const std::int64_t blocks = left.Blocks();
    // A list of each range of blocks, so that their order does not depend on threads.
    std::vector<std::vector<Entry>> found(static_cast<std::size_t>((blocks + grain - 1) / grain));
    const auto find = [&](std::int64_t block, std::vector<Entry>& entries) {
      std::int64_t index[BlockSize];
      double places[BlockSize * Dimension];
      bool deferred[BlockSize] = {};
      const int count = fillBlock(source, length, block, index, places);
      if (!this->Wide.Backward)
      {
        // Forwards a particle belongs to the tile of where the lattice takes it.
        double seeds[BlockSize * Dimension];
        std::copy_n(places, count * Dimension, seeds);
        this->Read(
          this->Wide, this->Map.Levels[this->Map.LevelCount - 1], seeds, count, places, deferred);
      }
      // Particles of a block are close together, and so in few tiles: a search among the block's
      // own entries is enough.
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
        // Bit i is particle i of the block.
        entry->Particles |= std::uint64_t{ 1 } << i;
      }
    };
    progress.For(
      blocks, grain,
      [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t block = begin; block < end && !progress.ShouldStop(); ++block)
        {
          find(block, found[static_cast<std::size_t>(block / grain)]);
        }
      },
      grain);
    return TileBins<Entry>(
      found, this->Plan.Tiles.Count(), [](const Entry& entry) { return entry.Tile; });
  }

  FlowMapView<Dimension> MapOfEntries() const
  {
    FlowMapView<Dimension> map = this->Map;
    if (this->Wide.Backward && !this->HandsOverFromMap())
    {
      // A level without records: all particles stop at the hand-over.
      map.LevelCount = 1;
      map.Levels[0].HandOver = this->Plan.HandOver;
      map.Levels[0].Records = nullptr;
    }
    return map;
  }

  // The job in the tables of tiles, where particles lie close together. The finest level of the map
  // ends at the hand-over.
  FlowJob<Dimension> JobOfTiles(const FlowMapView<Dimension>& map) const
  {
    FlowJob<Dimension> job = this->Wide;
    job.Sparse = false;
    job.Map = &map;
    return job;
  }

  // Gives TileTask the particles of an entry.
  struct EntryParticles
  {
    template <class Give>
    void operator()(const Entry& entry, const Give& give) const
    {
      std::int64_t index[BlockSize];
      double seeds[BlockSize * Dimension];
      // What is after its last particle in this tile is not used.
      const int count = BlockSize - __builtin_clzll(entry.Particles);
      this->Source.Fill(entry.Block * BlockSize, count, index, seeds);
      for (int i = 0; i < count; ++i)
      {
        if ((entry.Particles >> i & 1) != 0)
        {
          give(seeds + i * Dimension, index[i], entry.Block * BlockSize + i);
        }
      }
    }

    const ParticleSource<Dimension>& Source;
  };

  // Particles of a pass that are taken to the hand-over by themselves.
  struct Extra
  {
    std::vector<std::int64_t> Particle;    // their numbers in the row of particles
    LargeBuffer<float> Records;            // [particle][record] at the hand-over, as of lattices
    std::vector<unsigned char> Unresolved; // 1 where a box was empty on the way
  };

  // Takes all that is in `given` from the seeds, with 2^pass times as many steps; what is still
  // unresolved is in `left` then.
  void RunPass(const ParticleSource<Dimension>& source, int pass, const ParticleMask& given,
    std::int64_t count, PointSpan<Dimension> positions, ParticleMask& left, Progress& progress)
  {
    const std::int64_t most = this->Plan.ExtraParticles();
    const std::int64_t rounds = std::max<std::int64_t>(1, (count + most - 1) / most);
    Parts parts(progress, rounds);
    std::int64_t round = 0;
    std::int64_t block = 0;
    for (std::int64_t done = 0; this->Rounds.HasAnyRank(done < count);)
    {
      Extra extra;
      extra.Particle.reserve(static_cast<std::size_t>(std::min(most, count - done)));
      for (; block < given.Blocks(); ++block)
      {
        // A round takes as many whole blocks as the memory for records allows.
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
      // Other ranks may have more, and rounds are not quite full.
      this->RunExtra(source, pass, extra, positions, left, parts[std::min(round++, rounds - 1)]);
      done += static_cast<std::int64_t>(extra.Particle.size());
    }
  }

  // Takes particles from their seeds, or places, to the hand-over on the graded tables, where their
  // records are kept, and forwards to the end in their tiles. Backwards the way on the graded
  // tables comes last: the places are those at which the tiles left them, and the records are the
  // seeds.
  void RunExtra(const ParticleSource<Dimension>& source, int pass, Extra& extra,
    PointSpan<Dimension> positions, ParticleMask& left, Progress& progress)
  {
    constexpr int forward = FlowMapLevel<Dimension>::ForwardRecord;
    constexpr int backward = FlowMapLevel<Dimension>::BackwardRecord;
    const bool isBackward = this->Wide.Backward;
    const int record = isBackward ? backward : forward;
    const auto count = static_cast<std::int64_t>(extra.Particle.size());
    extra.Records = LargeBuffer<float>(count * record);
    extra.Unresolved.resize(static_cast<std::size_t>(count));

    // The particles are the nodes of a level without a lattice, which ends at the hand-over. In
    // pass 0 they start from the coarser lattices where these are good; with more steps the times
    // are others, and all start from their seeds.
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
    Stages stages(progress, { { "hand-over", 1 }, { "tiles", isBackward ? 0.0 : 1.0 } });
    stopWith(job, stages["hand-over"]);
    const auto particle = [&extra](std::int64_t number) {
      return extra.Particle[static_cast<std::size_t>(number)];
    };
    this->Count.Evaluations += NodeAdvance<Dimension>(job, level, stages["hand-over"])
                                 .Run(0, count, parents, extra.Unresolved.data(),
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
    // The numbers, in `extra`, of the particles that go on to their tile.
    // Those that met an empty box are redone, in the last pass from where they are all the same.
    map.Levels[0] = level;
    map.LevelCount = 1;
    std::vector<std::vector<std::int64_t>> numbers(1);
    numbers[0].reserve(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i)
    {
      if (extra.Unresolved[static_cast<std::size_t>(i)] && pass < this->LastPass)
      {
        left.Add(particle(i));
      }
      else
      {
        numbers[0].push_back(i);
      }
    }
    // Each particle goes to the tile of its place at the hand-over, and on from its state there:
    // one level, whose pass is -1.
    const TileBins<std::int64_t> bins(numbers, this->Plan.Tiles.Count(), [&](std::int64_t number) {
      double place[Dimension];
      std::copy_n(level.Records + number * record, Dimension, place);
      return this->Plan.TileOf(place);
    });
    job = this->JobOfTiles(map);
    job.FromStates = true;
    const TileStage<Dimension> stage{ job, -1, pass == this->LastPass, positions, left,
      this->Count };
    const auto giveNumber = [&](std::int64_t number, const auto& give) {
      std::int64_t index = 0;
      double seed[Dimension];
      source.Fill(particle(number), 1, &index, seed);
      double state[TileLanes<Dimension>::StateSize];
      std::copy_n(level.Records + number * record, TileLanes<Dimension>::StateSize, state);
      give(state, index, particle(number));
    };
    this->Rounds.Run(
      bins, TileTask(stage, this->Rounds.Tables(), bins, giveNumber), stages["tiles"]);
  }

  // The seeds that the records have, clamped to the domain.
  void WriteSeeds(
    const ParticleSource<Dimension>& source, const Extra& extra, PointSpan<Dimension> positions)
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

  // Those that are in an empty cell still.
  void MoveToMass(const ParticleSource<Dimension>& source, const ParticleMask& left,
    PointSpan<Dimension> positions)
  {
    this->Work.Threads().For(left.Blocks(), 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t block = first; block < last && !this->Work.ShouldStop(); ++block)
      {
        for (std::uint64_t word = left.Block(block); word != 0; word &= word - 1)
        {
          std::int64_t index = 0;
          double seed[Dimension];
          source.Fill(block * BlockSize + __builtin_ctzll(word), 1, &index, seed);
          moveToMass<Dimension>(this->Wide.Tables, positions[index], this->Count);
        }
      }
    });
    this->Work.Check();
  }

  const TilePlan<Dimension>& Plan;
  FlowJob<Dimension> Wide; // on the graded tables
  Counters& Count;
  Progress& Work;
  TileRounds<Dimension> Rounds;
  const ReadMap<Dimension> Read;
  const int LastPass;
  const std::vector<StepWeights> Weights;
  FlowMapView<Dimension> Map;
};

} // namespace RectifiedTransport

#endif
