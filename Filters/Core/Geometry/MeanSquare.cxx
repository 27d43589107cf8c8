// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/MeanSquare.h"

#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Reduction.h"

namespace RectifiedTransport
{

double meanSquare(const LengthScale& scale, ConstPointSpan<3> from, ConstPointSpan<3> to,
  const double* masses, double all, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  // Exact sums do not depend on the division among threads and ranks; distances in units of the
  // domain neither overflow nor vanish.
  const auto own = sumExactly<ExactSum>(
    progress, from.size(), grain, [&](std::int64_t first, std::int64_t last, ExactSum& sum) {
      for (std::int64_t i = first; i < last; ++i)
      {
        const double weight = masses ? masses[i] / all : 1.0;
        sum.Add(weight * scale.SquaredDistanceInUnits(from[i], to[i]));
      }
    });
  const double sum = sumOverRanks(progress.Group(), own).Value();
  return scale.CostFromUnits(masses ? sum : sum / all);
}

} // namespace RectifiedTransport
