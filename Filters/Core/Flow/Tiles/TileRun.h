// SPDX-License-Identifier: BSD-3-Clause
// The particles that are advected on the tables of tiles (TilePlan.h).
#ifndef RectifiedTransport_TileRun_h
#define RectifiedTransport_TileRun_h

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/Tiles/TileEntries.h"
#include "Core/Flow/Tiles/TileLanes.h"
#include "Core/Flow/Tiles/TilePlan.h"
#include "Core/Flow/Tiles/TileRounds.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace RectifiedTransport
{

// How the particles of tiles are advected: from their seeds, their places at time 1 or the states
// of a map's records.
template <int Dimension>
struct TileStage
{
  FlowMapView<Dimension> Map; // its finest level ends at the hand-over
  bool FromStates;            // see FlowJob
  bool StopsAtMap;            // see FlowJob
  bool IsKept;                // where particles are that stay unresolved
  int Pass;                   // of the kernel
};

// Gathers the particles of a tile in blocks (TileLanes.h), and lets the kernels advect them.
template <int Dimension>
class TileRun
{
public:
  // `wide` is the job on the graded tables.
  TileRun(const DensitySource<Dimension>& density, const GradedTables<Dimension>& graded,
    const TilePlan<Dimension>& plan, const FlowJob<Dimension>& wide, Counters& counters,
    Progress& progress)
    : Wide(wide)
    , Count(counters)
    , Work(progress)
    , Rounds(density, graded, plan.Tiles, progress)
  {
  }

  // Whether a condition holds here or on another rank.
  bool HasAnyRank(bool condition) const { return this->Rounds.HasAnyRank(condition); }

  // Makes the tables of each tile with items, and advects the particles that giveAll(item, give)
  // gives.
  template <class Item, class GiveAll>
  void Run(const ByTile<Item>& items, const TileStage<Dimension>& stage,
    PointSpan<Dimension> positions, ParticleMask& left, double begin, double end,
    const GiveAll& giveAll)
  {
    this->Rounds.Run(
      items, Advection<Item, GiveAll>{ *this, items, stage, positions, left, giveAll }, begin, end);
  }

private:
  static constexpr std::int64_t grain = 32; // entries or blocks a range

  // What TileRounds does with the tables of a tile.
  template <class Item, class GiveAll>
  struct Advection
  {
    static constexpr double Cell = 0.02; // measured, in the time of a particle

    void Run(std::int64_t first, std::int64_t last)
    {
      // Each range has lanes of its own, and so at most one block that is not full.
      const FlowJob<Dimension> job = this->Parent.TileJob(this->Stage);
      this->Parent.Work.For(
        last - first, grain,
        [&](std::int64_t b, std::int64_t e) {
          TileLanes<Dimension> lanes(job, this->Stage.Pass, this->Stage.IsKept, this->Positions,
            this->Left, this->Parent.Count.Evaluations);
          for (std::int64_t item = first + b; item < first + e && !this->Parent.Work.ShouldStop();
               ++item)
          {
            this->Give(this->Items[item],
              [&](const double* values, std::int64_t index, std::int64_t particle) {
                // Lanes are filled over the borders of items, and advanced when a block is full;
                // the rest at the end of the range.
                std::copy_n(values, lanes.ValuesEach(), lanes.Next());
                lanes.Add(index, particle);
              });
          }
          lanes.Advance();
        },
        grain);
    }
    int ValuesEach() const { return TileLanes<Dimension>::valuesOf(this->Stage.FromStates); }
    template <class GiveOne>
    void Give(const Item& item, const GiveOne& give) const
    {
      this->GiveItem(item, give);
    }
    Bytes Serve(Bytes visitors) { return this->Parent.AdvectVisitors(this->Stage, visitors); }
    // Unresolved ones are written only if they are kept.
    void Take(const char* reply, std::int64_t index, std::int64_t particle)
    {
      constexpr std::size_t bytes = sizeof(double) * Dimension;
      const bool isUnresolved = reply[bytes] != 0;
      if (!isUnresolved || this->Stage.IsKept)
      {
        std::memcpy(this->Positions[index], reply, bytes);
      }
      if (isUnresolved)
      {
        this->Left.Add(particle);
      }
    }

    TileRun& Parent;
    const ByTile<Item>& Items;
    const TileStage<Dimension>& Stage;
    const PointSpan<Dimension> Positions;
    ParticleMask& Left;
    const GiveAll& GiveItem;
  };

  // The job on the tables of the tile that is worked on. Its particles lie close together.
  FlowJob<Dimension> TileJob(const TileStage<Dimension>& stage) const
  {
    FlowJob<Dimension> job = this->Wide;
    job.Tables = this->Rounds.Tables();
    job.Sparse = false;
    job.Map = &stage.Map;
    job.FromStates = stage.FromStates;
    job.StopsAtMap = stage.StopsAtMap;
    return job;
  }

  // Of the particles that a rank sent: where each ends, and a byte that says whether it is
  // unresolved.
  Bytes AdvectVisitors(const TileStage<Dimension>& stage, Bytes& visitors)
  {
    // [particle][each] as they were sent.
    const int each = TileLanes<Dimension>::valuesOf(stage.FromStates);
    const std::vector<double> values = fromBytes<double>(visitors);
    visitors = {};
    const auto count = static_cast<std::int64_t>(values.size()) / each;
    // All ends are written and sent, with the mark: the sender decides whether it takes them.
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

  const FlowJob<Dimension>& Wide; // on the graded tables
  Counters& Count;
  Progress& Work;
  TileRounds<Dimension> Rounds;
};

} // namespace RectifiedTransport

#endif
