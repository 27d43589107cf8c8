// SPDX-License-Identifier: BSD-3-Clause
// The position of a particle between densities that share a pivot (paper, Section 3.4): the
// weighted mean of its positions. Between two densities it moves on a straight line.
#ifndef RectifiedTransport_WeightedMean_h
#define RectifiedTransport_WeightedMean_h

#include "../Geometry/Points.h"
#include "../Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct WeightedPositions
{
  ConstPointSpan<3> Positions;
  double Weight;
};

// Writes points [first, last) of the sum of weight * positions. Parts of weight 0 are not read; a
// single part of weight 1 is copied bitwise. At least one weight is not 0.
void writeWeightedMean(const std::vector<WeightedPositions>& parts, std::int64_t first,
  std::int64_t last, PointSpan<3> mean);
// Writes all of them. Throws Cancelled.
void writeWeightedMean(const std::vector<WeightedPositions>& parts, PointSpan<3> mean,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
