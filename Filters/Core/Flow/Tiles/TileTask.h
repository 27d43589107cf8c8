// SPDX-License-Identifier: BSD-3-Clause
// The particles that are advected on the tables of tiles (TilePlan.h).
#ifndef RectifiedTransport_TileTask_h
#define RectifiedTransport_TileTask_h

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/Tiles/TileEntries.h"
#include "Core/Flow/Tiles/TileLanes.h"
#include "Core/Parallel/Progress.h"
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

// Where results go.
template <int Dimension>
struct TileResults
{
  const PointSpan<Dimension> Positions;
  ParticleMask& Left; // those that are unresolved
  Counters& Count;
};

// What TileRounds does in an advection with the tables of a tile: gathers the tile's particles in
// blocks (TileLanes.h), and lets the kernels advect them. GiveItem has an operator()(item, give)
// that calls give(values, index, particle) for each particle of an item.
template <int Dimension, class Item, class GiveItem>
class TileTask
{
public:
  static constexpr double Cell = 0.02; // measured, in the time of a particle

  // `wide` is the job on the graded tables, `tables` those of the tile that is worked on.
  TileTask(const FlowJob<Dimension>& wide, const TableView<Dimension>& tables,
    const TileStage<Dimension>& stage, const ByTile<Item>& items, const GiveItem& giveItem,
    const TileResults<Dimension>& results)
    : Job(wide)
    , Tables(tables)
    , Stage(stage)
    , Items(items)
    , GiveParticles(giveItem)
    , Results(results)
  {
    this->Job.Sparse = false; // particles of a tile lie close together
    this->Job.Map = &stage.Map;
    this->Job.FromStates = stage.FromStates;
    this->Job.StopsAtMap = stage.StopsAtMap;
  }

  void Run(std::int64_t first, std::int64_t last, Progress& progress)
  {
    this->Job.Tables = this->Tables;
    stopWith(this->Job, progress);
    progress.For(
      last - first, grain,
      [&](std::int64_t b, std::int64_t e) {
        // Each range has lanes of its own, and so at most one block that is not full.
        TileLanes<Dimension> lanes(this->Job, this->Stage.Pass, this->Stage.IsKept,
          this->Results.Positions, this->Results.Left, this->Results.Count.Evaluations);
        for (std::int64_t item = first + b; item < first + e && !progress.ShouldStop(); ++item)
        {
          this->GiveParticles(this->Items[item],
            [&](const double* values, std::int64_t index, std::int64_t particle) {
              // Lanes are filled over the borders of items, and advanced when a block is full; the
              // rest at the end of the range.
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
    this->GiveParticles(item, give);
  }

  // Of the particles that a rank sent: where each ends, and a byte that says whether it is
  // unresolved.
  Bytes Serve(Bytes visitors, Progress& progress)
  {
    this->Job.Tables = this->Tables;
    stopWith(this->Job, progress);
    // [particle][each] as they were sent.
    const int each = this->ValuesEach();
    const std::vector<double> values = fromBytes<double>(visitors);
    visitors = {};
    const auto count = static_cast<std::int64_t>(values.size()) / each;
    // All ends are written and sent, with the mark: the sender decides whether it takes them.
    std::vector<double> ends(static_cast<std::size_t>(count * Dimension));
    ParticleMask unresolved(count);
    const PointSpan<Dimension> places(ends.data(), count);
    constexpr std::int64_t particles = grain * BlockSize;
    progress.For(
      count, particles,
      [&](std::int64_t first, std::int64_t last) {
        TileLanes<Dimension> lanes(
          this->Job, this->Stage.Pass, true, places, unresolved, this->Results.Count.Evaluations);
        for (std::int64_t i = first; i < last && !progress.ShouldStop(); ++i)
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
  // Unresolved ones are written only if they are kept.
  void Take(const char* reply, std::int64_t index, std::int64_t particle)
  {
    constexpr std::size_t bytes = sizeof(double) * Dimension;
    const bool isUnresolved = reply[bytes] != 0;
    if (!isUnresolved || this->Stage.IsKept)
    {
      std::memcpy(this->Results.Positions[index], reply, bytes);
    }
    if (isUnresolved)
    {
      this->Results.Left.Add(particle);
    }
  }

private:
  static constexpr std::int64_t grain = 32; // entries or blocks a range

  FlowJob<Dimension> Job;
  const TableView<Dimension>& Tables;
  const TileStage<Dimension>& Stage;
  const ByTile<Item>& Items;
  const GiveItem& GiveParticles;
  const TileResults<Dimension> Results;
};

} // namespace RectifiedTransport

#endif
