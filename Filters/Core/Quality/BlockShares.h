// SPDX-License-Identifier: BSD-3-Clause
// The shares of a density's mass in blocks of its grid.
#ifndef RectifiedTransport_BlockShares_h
#define RectifiedTransport_BlockShares_h

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Quality/GridBlocks.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// The shares of `count` blocks from `first` on. Collective on the ranks of the progress, each for
// its own blocks; a rank holds a few million cells of the density at a time. Throws std::bad_alloc
// and Cancelled.
template <int Dimension>
void findBlockShares(const RectifiedFlow<Dimension>& flow, const GridBlocks<Dimension>& blocks,
  std::int64_t first, std::int64_t count, double* shares, Progress& progress);

} // namespace RectifiedTransport

#endif
