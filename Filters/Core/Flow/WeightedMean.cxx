// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/WeightedMean.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>

namespace RectifiedTransport
{

void writeWeightedMean(const std::vector<WeightedPositions>& parts, std::int64_t first,
  std::int64_t last, PointSpan<3> mean)
{
  // Coordinates: a block of the sum stays in the L1 cache from part to part.
  constexpr std::int64_t block = 1024;
  const std::int64_t end = 3 * last;
  for (std::int64_t begin = 3 * first; begin < end; begin += block)
  {
    const std::int64_t count = std::min(block, end - begin);
    double* sum = mean.data() + begin;
    // The first part with a weight initializes the sum, so the output need not be cleared.
    bool isFirst = true;
    for (const WeightedPositions& part : parts)
    {
      const double weight = part.Weight;
      if (weight == 0.0)
      {
        continue;
      }
      const double* positions = part.Positions.data() + begin;
      if (isFirst)
      {
#pragma omp simd
        for (std::int64_t i = 0; i < count; ++i)
        {
          sum[i] = weight * positions[i];
        }
      }
      else
      {
#pragma omp simd
        for (std::int64_t i = 0; i < count; ++i)
        {
          sum[i] += weight * positions[i];
        }
      }
      isFirst = false;
    }
  }
}

void writeWeightedMean(
  const std::vector<WeightedPositions>& parts, PointSpan<3> mean, const Context& context)
{
  // Points a chunk.
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  Progress progress(context);
  progress.For(mean.size(), grain,
    [&](std::int64_t first, std::int64_t last) { writeWeightedMean(parts, first, last, mean); });
}

} // namespace RectifiedTransport
