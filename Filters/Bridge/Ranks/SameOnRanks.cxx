// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/SameOnRanks.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

std::string requireSameOnRanks(
  const Ranks& ranks, const std::string& own, const std::string& what, const std::string& rule)
{
  const std::vector<Bytes> all = ranks.Gather(Bytes(own.begin(), own.end()));
  std::string common;
  std::size_t first = 0;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    const std::string there(all[rank].begin(), all[rank].end());
    first = common.empty() ? rank : first;
    common = common.empty() ? there : common;
    if (!there.empty() && there != common)
    {
      throw Failure(what + common + " on rank " + std::to_string(first) + ", but " + there +
        " on rank " + std::to_string(rank) + "; " + rule);
    }
  }
  return common;
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
  if (!ranks.AreSeveral())
  {
    return whole;
  }
  const bool isKnown = announcedGrid(output, true).Extent() == whole;
  if (onAllRanks(ranks, isKnown))
  {
    return withCells(requestedExtent(output), whole);
  }
  return dividedExtent(whole, ranks.Count())[static_cast<std::size_t>(ranks.Own())];
}

} // namespace RectifiedTransport
