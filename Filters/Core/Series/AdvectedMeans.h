// SPDX-License-Identifier: BSD-3-Clause
// Values that move along with particles: means by mass.
#ifndef RectifiedTransport_AdvectedMeans_h
#define RectifiedTransport_AdvectedMeans_h

#include "Core/Series/SeriesParticles.h"

#include <array>
#include <cstdint>

namespace RectifiedTransport
{

// One component of an array, at both ends of the particles' ways.
struct AdvectedValues
{
  std::array<const double*, 2> OfParticles;
  std::array<const double*, 2> InPlace; // one per cell of the image, axis 0 fastest
  std::int64_t Stride;                  // from one particle or cell to the next

  // Each value is linear in time; at an end, the value of that end alone counts, even if the other
  // is not finite.
  static double Between(const std::array<const double*, 2>& ends, std::int64_t at, double part)
  {
    return part <= 0.0 ? ends[0][at]
      : part >= 1.0    ? ends[1][at]
                       : (1.0 - part) * ends[0][at] + part * ends[1][at];
  }
};

// Writes the values of the particles at a moment times their masses. Throws Cancelled.
void writeMoments(
  const AdvectedValues& values, const SeriesSnapshot& moment, Progress& progress, double* moments);

// Divides the sums of these in a part of an image by the masses. Cells without mass get the values
// in place. Throws Cancelled.
void writeMeans(const AdvectedValues& values, double part, const LatticePart<3>& image,
  const LatticePart<3>& wanted, const double* masses, Progress& progress, double* sums);

} // namespace RectifiedTransport

#endif
