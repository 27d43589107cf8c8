// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/UnusualBlocks.h"

#include "Bridge/Density/UnusualValues.h"
#include "Bridge/Resampling/MeshDensity.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/DensityInspection.h"

namespace RectifiedTransport
{

namespace
{

// The values of all blocks; `of` is the block that the first index belongs to.
template <class Found>
struct InBlocks
{
  Found All{};
  const BlockValues* Of = nullptr;

  void Add(const Found& part, bool isBeyond, const BlockValues& block)
  {
    const auto first = this->Of ? firstOf(this->All) : -1;
    merge(part, this->All);
    if (!this->Of || isBeyond)
    {
      this->Of = &block;
      return;
    }
    firstOf(this->All) = first; // blocks number their values each from 0
  }

private:
  static std::int64_t& firstOf(DensitySummary& found) { return found.FirstMaximum; }
  static std::int64_t& firstOf(LargestValue& found) { return found.First; }
  static std::int64_t& firstOf(LowestValue& found) { return found.First; }
};

} // namespace

std::vector<std::string> describeUnusual(const std::vector<BlockValues>& blocks,
  const ImageGrid& grid, bool isInverted, Progress& progress)
{
  InBlocks<DensitySummary> largest;
  InBlocks<LargestValue> white;
  InBlocks<LowestValue> lowest;
  std::int64_t values = 0;
  for (const BlockValues& block : blocks)
  {
    const UnusualValues& known = block.Unusual();
    largest.Add(known.Found, known.Found.Maximum > largest.All.Maximum, block);
    white.Add(known.White, known.White.Value > white.All.Value, block);
    lowest.Add(known.Clamped, known.Clamped.Value < lowest.All.Value, block);
    values += block.NumberOfValues();
  }
  const auto placesIn = [values](const BlockValues& block) {
    return ValuePlaces{ block.Name(), block.IsOnPoints() ? "points" : "cells", values };
  };
  std::vector<std::string> lines;
  const double raw = isInverted ? white.All.Value - largest.All.Maximum : largest.All.Maximum;
  if (isUnusualLargest(largest.All, raw, values))
  {
    std::vector<BlockValues> only;
    only.reserve(blocks.size());
    for (const BlockValues& block : blocks)
    {
      only.push_back(block.Only(largest.All.Maximum));
    }
    const double share = MeshDensity::IntegralOf(only, grid, progress) /
      MeshDensity::IntegralOf(blocks, grid, progress);
    if (share > mostOfMass)
    {
      lines.push_back(describeLargest(placesIn(*largest.Of), largest.All, raw, share));
    }
  }
  else if (isInverted && isUnusualWhite(white.All))
  {
    lines.push_back(describeWhite(placesIn(*white.Of), white.All));
  }
  if (isUnusualLowest(lowest.All))
  {
    lines.push_back(describeLowest(placesIn(*lowest.Of), lowest.All));
  }
  return lines;
}

} // namespace RectifiedTransport
