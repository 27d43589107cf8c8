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

namespace
{

// A layer of points has no cells in an image that has some along its axis: with those next to it.
Extent withCells(const Extent& extent, const Extent& whole)
{
  Extent grown = extent;
  for (std::size_t low = 0; low < grown.size() && !isEmpty(extent); low += 2)
  {
    if (extent[low] == extent[low + 1] && whole[low] < whole[low + 1])
    {
      grown[low] -= extent[low + 1] == whole[low + 1] ? 1 : 0;
      grown[low + 1] = grown[low] + 1;
    }
  }
  return grown;
}

} // namespace

Extent extentToGive(const Extent& whole, vtkInformation* output, const Ranks& ranks)
{
  const bool isKnown = announcedGrid(output, true).Extent() == whole;
  if (onAllRanks(&ranks, isKnown))
  {
    return withCells(requestedExtent(output), whole);
  }
  return dividedExtent(whole, ranks.Count())[static_cast<std::size_t>(ranks.Own())];
}

} // namespace RectifiedTransport
