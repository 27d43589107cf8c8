// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/SameOnRanks.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/Failure.h"

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

Extent extentToGive(const Extent& whole, vtkInformation* output, const Ranks& ranks)
{
  const bool isKnown = announcedGrid(output, true).Extent() == whole;
  if (onAllRanks(&ranks, isKnown))
  {
    return requestedExtent(output);
  }
  return dividedExtent(whole, ranks.Count())[static_cast<std::size_t>(ranks.Own())];
}

} // namespace RectifiedTransport
