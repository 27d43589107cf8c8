// SPDX-License-Identifier: BSD-3-Clause
// The data sets of a density that lie on several ranks, on each of them.
#ifndef RectifiedTransport_GatheredBlocks_h
#define RectifiedTransport_GatheredBlocks_h

#include "Bridge/Blocks/DataContent.h"
#include "Bridge/Blocks/DensityBlocks.h"
#include "Core/Parallel/Ranks.h"

#include <vector>

namespace RectifiedTransport
{

class Progress;

// Keeps those of the last run: they are gathered again only where those of a rank change.
class GatheredBlocks
{
public:
  // By the numbers of the blocks, and the parts of one by rank; what is the same on several ranks
  // once. Called by all ranks. Throws Failure, Cancelled and std::bad_alloc.
  const std::vector<DensityBlock>& Gather(
    const std::vector<DensityBlock>& own, const Ranks& ranks, Progress& progress);

private:
  DataContent Content; // of this rank's blocks
  bool HasBlocks = false;
  std::vector<DensityBlock> Blocks;
};

} // namespace RectifiedTransport

#endif
