// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/AdvectedMeans.h"

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

} // namespace

// The moment of a particle is mass * value; moments and masses are splatted alike, and their
// quotient is the mean by mass.
void writeMoments(
  const AdvectedValues& values, const SeriesSnapshot& moment, Progress& progress, double* moments)
{
  const double* masses = moment.Masses();
  progress.ForEach(moment.Count(), grain, [&](std::int64_t i) {
    const std::int64_t at = values.Stride * (moment.First() + i);
    moments[i] = masses[i] * AdvectedValues::Between(values.OfParticles, at, moment.Part());
  });
}

// Cells without mass take the value in place, linear in time.
void writeMeans(const AdvectedValues& values, double part, const LatticePart<3>& image,
  const LatticePart<3>& wanted, const double* masses, Progress& progress, double* sums)
{
  progress.ForEach(wanted.Count(), grain, [&](std::int64_t i) {
    const std::int64_t at = values.Stride * image.NumberOf(wanted.CellOf(i));
    sums[i] =
      masses[i] > 0.0 ? sums[i] / masses[i] : AdvectedValues::Between(values.InPlace, at, part);
  });
}

} // namespace RectifiedTransport
