// SPDX-License-Identifier: BSD-3-Clause
// Where a particle is between densities that it reaches from one pivot (Section 3.4): at the mean
// of its positions, weighted. Of two densities it moves on a straight line.
#ifndef RectifiedTransport_WeightedMean_h
#define RectifiedTransport_WeightedMean_h

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct WeightedPositions
{
  const double* Positions;
  double Weight;
};

// Writes the numbers [first, last) of the sum of weight * positions. Parts of weight 0 are not
// read; one of weight 1 alone comes out to the bit. There is at least one other than 0.
void writeWeightedMean(
  const std::vector<WeightedPositions>& parts, std::int64_t first, std::int64_t last, double* mean);

} // namespace RectifiedTransport

#endif
