// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/WeightedMean.h"

#include <algorithm>

namespace RectifiedTransport
{

void writeWeightedMean(
  const std::vector<WeightedPositions>& parts, std::int64_t first, std::int64_t last, double* mean)
{
  // Doubles: a block of the sum stays in the L1 cache from part to part.
  constexpr std::int64_t block = 1024;
  for (std::int64_t begin = first; begin < last; begin += block)
  {
    const std::int64_t count = std::min(block, last - begin);
    double* sum = mean + begin;
    bool isFirst = true;
    for (const WeightedPositions& part : parts)
    {
      const double* positions = part.Positions + begin;
      const double weight = part.Weight;
      if (weight == 0.0)
      {
        continue;
      }
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

} // namespace RectifiedTransport
