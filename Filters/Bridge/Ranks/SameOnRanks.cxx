// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/SameOnRanks.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/Failure.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

void requireSameOnRanks(const Ranks& ranks, const std::string& own, const std::string& what)
{
  const std::vector<Bytes> all = ranks.Gather(Bytes(own.begin(), own.end()));
  const std::string first(all.front().begin(), all.front().end());
  for (std::size_t rank = 1; rank < all.size(); ++rank)
  {
    const std::string other(all[rank].begin(), all[rank].end());
    if (other != first)
    {
      throw Failure(what + first + " on rank 0, but " + other + " on rank " + std::to_string(rank) +
        "; it must be of one type on all");
    }
  }
}

std::array<double, 6> boundsOfAll(const Ranks& ranks, const std::array<double, 6>& own)
{
  std::array<double, 6> all = own;
  for (const std::array<double, 6>& bounds : gatherValues(ranks, own))
  {
    if (bounds[0] > bounds[1])
    {
      continue;
    }
    const bool isFirst = all[0] > all[1];
    for (std::size_t i = 0; i < 6; i += 2)
    {
      all[i] = isFirst ? bounds[i] : std::min(all[i], bounds[i]);
      all[i + 1] = isFirst ? bounds[i + 1] : std::max(all[i + 1], bounds[i + 1]);
    }
  }
  return all;
}

Extent extentToGive(const ImageGrid& grid, vtkInformation* output, const Ranks& ranks)
{
  const bool isKnown = announcedGrid(output, grid.IsOnPoints()) == grid;
  if (onAllRanks(&ranks, isKnown))
  {
    return requestedExtent(output);
  }
  return dividedExtent(grid.Extent(), ranks.Count())[static_cast<std::size_t>(ranks.Own())];
}

} // namespace RectifiedTransport
