// SPDX-License-Identifier: BSD-3-Clause
// Values of resampled data sets that are probably not meant, by the mass of the cells that they are
// in.
#ifndef RectifiedTransport_UnusualBlocks_h
#define RectifiedTransport_UnusualBlocks_h

#include "Bridge/Blocks/BlockValues.h"
#include "Core/Geometry/ImageGrid.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// A line for each finding. Throws Failure if memory is short, and Cancelled.
std::vector<std::string> describeUnusual(const std::vector<BlockValues>& blocks,
  const ImageGrid& grid, bool isInverted, Progress& progress);

} // namespace RectifiedTransport

#endif
