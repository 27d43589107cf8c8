// SPDX-License-Identifier: BSD-3-Clause
// The particles that are advected on the tables of tiles (TilePlan.h).
#ifndef RectifiedTransport_TileTask_h
#define RectifiedTransport_TileTask_h

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Flow/Tiles/TileBins.h"
#include "Core/Geometry/Points.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

// Particles of one tile, gathered from several blocks to be advected together. A block of the
// kernels has few particles of a tile: it would be mostly idle lanes. Which particles are gathered
// depends on the ranges of the work, but no lane's result depends on the others.
template <int Dimension>
class TileLanes
{
public:
  static constexpr int StateSize = 4 * Dimension; // position and three velocities

  // Writes the positions of the resolved particles, or of all if these are kept; the others are
  // added to those that are left. The job is on the tile's tables.
  TileLanes(const FlowJob<Dimension>& job, int pass, bool keepsUnresolved,
    PointSpan<Dimension> positions, ParticleMask& left, std::atomic<std::int64_t>& evaluations)
    : Job(job)
    , Pass(pass)
    , KeepsUnresolved(keepsUnresolved)
    , Positions(positions)
    , Left(left)
    , Evaluations(evaluations)
    , Advect(flowKernels<Dimension>().Advect)
    , Size(valuesOf(job.FromStates))
  {
    this->Job.Output = this->Ends;
    std::iota(this->Numbers, this->Numbers + BlockSize, std::int64_t{ 0 });
  }

  // How many doubles a particle's seed, or its state, has.
  static int valuesOf(bool fromStates) { return fromStates ? StateSize : Dimension; }

  // Takes the seed, or the state, of a particle, for a place in the positions, and advances all if
  // there are no more lanes.
  void Add(const double* values, std::int64_t index, std::int64_t particle)
  {
    std::copy_n(values, this->Size, this->Seeds + this->Count * this->Size);
    this->Index[this->Count] = index;
    this->Particle[this->Count] = particle;
    if (++this->Count == BlockSize)
    {
      this->Advance();
    }
  }

  void Advance()
  {
    if (this->Count == 0)
    {
      return;
    }
    // The kernel writes to Ends: the ends of unresolved particles must not overwrite where they
    // were, unless they are kept.
    bool unresolved[BlockSize] = {};
    this->Evaluations +=
      this->Advect(this->Job, this->Seeds, this->Numbers, this->Count, this->Pass, unresolved);
    for (int i = 0; i < this->Count; ++i)
    {
      if (!unresolved[i] || this->KeepsUnresolved)
      {
        std::copy_n(this->Ends + i * Dimension, Dimension, this->Positions[this->Index[i]]);
      }
      if (unresolved[i])
      {
        this->Left.Add(this->Particle[i]);
      }
    }
    this->Count = 0;
  }

private:
  FlowJob<Dimension> Job;
  const int Pass;
  const bool KeepsUnresolved;
  const PointSpan<Dimension> Positions;
  ParticleMask& Left;
  std::atomic<std::int64_t>& Evaluations;
  const AdvectBlock<Dimension> Advect;
  const int Size;                      // doubles a particle
  int Count = 0;                       // of gathered particles
  double Seeds[BlockSize * StateSize]; // [particle][Size]: seeds or states
  double Ends[BlockSize * Dimension];  // [particle][Dimension], the kernel's output
  std::int64_t Index[BlockSize];       // in the positions
  std::int64_t Particle[BlockSize];    // in the row of particles, for those that are left
  std::int64_t Numbers[BlockSize];     // 0, 1, ...: places in Ends
};

// How the kernels advect the particles of tiles, and where results go.
template <int Dimension>
struct TileStage
{
  FlowJob<Dimension> Job; // its tables are set for each tile
  int Pass;               // of the kernel
  bool KeepsUnresolved;   // where particles are that stay unresolved
  const PointSpan<Dimension> Positions;
  ParticleMask& Left; // those that are unresolved
  Counters& Count;
};

// What TileRounds does in an advection with the tables of a tile: gathers the tile's particles in
// blocks (TileLanes), and lets the kernels advect them. GiveItem has an operator()(item, give)
// that calls give(values, index, particle) for each particle of an item.
template <int Dimension, class Item, class GiveItem>
class TileTask
{
public:
  static constexpr double Cell = 0.02; // measured, in the time of a particle

  // `tables` are those of the tile that is worked on.
  TileTask(const TileStage<Dimension>& stage, const TableView<Dimension>& tables,
    const TileBins<Item>& items, const GiveItem& giveItem)
    : Stage(stage)
    , Tables(tables)
    , Items(items)
    , GiveParticles(giveItem)
  {
  }

  void Run(std::int64_t first, std::int64_t last, Progress& progress)
  {
    // Lanes are filled over the borders of items, and advanced when a block is full; the rest at
    // the end of the range.
    this->Advance(
      last - first, grain, this->Stage, progress, [&](std::int64_t i, TileLanes<Dimension>& lanes) {
        this->GiveParticles(this->Items[first + i],
          [&](const double* values, std::int64_t index, std::int64_t particle) {
            lanes.Add(values, index, particle);
          });
      });
  }
  int ValuesEach() const { return TileLanes<Dimension>::valuesOf(this->Stage.Job.FromStates); }
  template <class GiveOne>
  void Give(const Item& item, const GiveOne& give) const
  {
    this->GiveParticles(item, give);
  }

  // Returns where each of the particles that a rank sent ends, and a byte that says whether it is
  // unresolved.
  Bytes Process(Bytes visitors, Progress& progress)
  {
    // [particle][each] as they were sent.
    const int each = this->ValuesEach();
    const std::vector<double> values = fromBytes<double>(visitors);
    visitors = {};
    const auto count = static_cast<std::int64_t>(values.size()) / each;
    // All ends are written and sent, with the mark: the sender decides whether it takes them.
    std::vector<double> ends(static_cast<std::size_t>(count * Dimension));
    ParticleMask unresolved(count);
    const PointSpan<Dimension> places(ends.data(), count);
    const TileStage<Dimension> stage{ this->Stage.Job, this->Stage.Pass, true, places, unresolved,
      this->Stage.Count };
    this->Advance(
      count, grain * BlockSize, stage, progress, [&](std::int64_t i, TileLanes<Dimension>& lanes) {
        lanes.Add(values.data() + i * each, i, i);
      });
    // A reply is [particle]{Dimension doubles, one byte}, in the order in which the particles came.
    constexpr std::size_t bytes = sizeof(double) * Dimension;
    Bytes reply(static_cast<std::size_t>(count) * (bytes + 1));
    char* next = reply.data();
    for (std::int64_t i = 0; i < count; ++i, next += bytes + 1)
    {
      std::memcpy(next, places[i], bytes);
      next[bytes] = unresolved.Has(i) ? 1 : 0;
    }
    return reply;
  }
  // Unresolved ones are written only if they are kept.
  void Take(const char* reply, std::int64_t index, std::int64_t particle)
  {
    constexpr std::size_t bytes = sizeof(double) * Dimension;
    const bool isUnresolved = reply[bytes] != 0;
    if (!isUnresolved || this->Stage.KeepsUnresolved)
    {
      std::memcpy(this->Stage.Positions[index], reply, bytes);
    }
    if (isUnresolved)
    {
      this->Stage.Left.Add(particle);
    }
  }

private:
  static constexpr std::int64_t grain = 32; // entries or blocks a range

  // add(i, lanes) for the items [0, count). Each range has lanes of its own, and so at most one
  // block that is not full.
  template <class AddItem>
  void Advance(std::int64_t count, std::int64_t itemsOfRange, const TileStage<Dimension>& stage,
    Progress& progress, const AddItem& add) const
  {
    FlowJob<Dimension> job = stage.Job;
    job.Tables = this->Tables;
    stopWith(job, progress);
    progress.For(
      count, itemsOfRange,
      [&](std::int64_t first, std::int64_t last) {
        TileLanes<Dimension> lanes(job, stage.Pass, stage.KeepsUnresolved, stage.Positions,
          stage.Left, stage.Count.Evaluations);
        for (std::int64_t i = first; i < last && !progress.ShouldStop(); ++i)
        {
          add(i, lanes);
        }
        lanes.Advance();
      },
      itemsOfRange);
  }

  const TileStage<Dimension>& Stage;
  const TableView<Dimension>& Tables;
  const TileBins<Item>& Items;
  const GiveItem& GiveParticles;
};

} // namespace RectifiedTransport

#endif
