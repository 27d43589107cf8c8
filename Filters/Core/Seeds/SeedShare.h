// SPDX-License-Identifier: BSD-3-Clause
// The seeds of one of several ranks.
#ifndef RectifiedTransport_SeedShare_h
#define RectifiedTransport_SeedShare_h

#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"
#include "Core/Seeds/UnitSeeds.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// The seeds of a rank among the seeds of all ranks.
struct SeedShare
{
  // Divides a pattern of `pattern` seeds, which may exceed every integer.
  SeedShare(double pattern, int ranks, int rank)
    : All(static_cast<std::int64_t>(std::min(pattern, most)))
  {
    const RankShare share(this->All, ranks, rank);
    this->First = share.First;
    this->Count = pattern > most ? pattern / ranks : static_cast<double>(share.Count);
  }
  // Counts the seeds that each rank has. Collective.
  SeedShare(std::int64_t own, const Ranks& ranks)
    : Count(static_cast<double>(own))
  {
    int rank = 0;
    for (const std::int64_t count : gatherValues<std::int64_t>(ranks, own))
    {
      this->First += rank++ < ranks.Own() ? count : 0;
      this->All += count;
    }
  }

  std::int64_t First = 0;
  double Count;
  std::int64_t All = 0;

private:
  static constexpr double most = 9e18; // the largest number of seeds that an integer counts
};

// Writes the seeds of a pattern from number `first` on, in the index space of a grid. Throws
// std::bad_alloc and Cancelled.
template <int D>
void writeSeeds(const UnitSeeds<D>& pattern, const GridSize<D>& size, std::int64_t first,
  Progress& progress, PointSpan<D> seeds)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  Stages stages(progress, { { "pattern", 8 }, { "scale", 2 } });
  pattern.GenerateFrom(first, seeds, stages["pattern"]);
  stages["scale"].ForEach(seeds.size(), grain, [=](std::int64_t i) {
    for (int a = 0; a < D; ++a)
    {
      seeds[i][a] *= static_cast<double>(size[a]);
    }
  });
}

} // namespace RectifiedTransport

#endif
