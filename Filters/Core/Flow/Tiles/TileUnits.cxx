// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Tiles/TileUnits.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace RectifiedTransport
{

std::vector<std::vector<TileUnit>> assignTiles(
  const std::vector<std::int64_t>& particles, double costOfTables, int ranks)
{
  struct Costly
  {
    TileUnit Unit;
    double Cost;
  };
  const std::int64_t all = std::accumulate(particles.begin(), particles.end(), std::int64_t{ 0 });
  const std::int64_t most = std::max<std::int64_t>(1, (all + ranks - 1) / ranks);
  std::vector<Costly> units;
  for (std::size_t tile = 0; tile < particles.size(); ++tile)
  {
    const std::int64_t count = particles[tile];
    const std::int64_t shares = (count + most - 1) / most;
    for (std::int64_t share = 0; share < shares; ++share)
    {
      units.push_back({ { static_cast<std::int64_t>(tile), share, shares },
        static_cast<double>(count) / static_cast<double>(shares) + costOfTables });
    }
  }
  // The costliest first, each to the rank with the least work so far.
  std::stable_sort(
    units.begin(), units.end(), [](const Costly& a, const Costly& b) { return a.Cost > b.Cost; });
  std::vector<std::vector<TileUnit>> assigned(static_cast<std::size_t>(ranks));
  std::vector<double> work(assigned.size(), 0.0);
  for (const Costly& unit : units)
  {
    const auto rank =
      static_cast<std::size_t>(std::min_element(work.begin(), work.end()) - work.begin());
    assigned[rank].push_back(unit.Unit);
    work[rank] += unit.Cost;
  }
  return assigned;
}

} // namespace RectifiedTransport
