// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_SeedPatterns_h
#define RectifiedTransport_SeedPatterns_h

#include "Core/Seeds/Seeds.h"

#include <iterator>

// The seed patterns, for tests that try each of them.
namespace RectifiedTransport
{

inline constexpr SeedPattern seedPatterns[] = { SeedPattern::BlueNoise, SeedPattern::Lattice,
  SeedPattern::Jittered, SeedPattern::LowDiscrepancy, SeedPattern::Random };

// In VTK's classes they are numbers from 0 on.
inline constexpr int numberOfSeedPatterns = static_cast<int>(std::size(seedPatterns));

// All but Lattice: they have any number of points.
inline constexpr SeedPattern scatteredPatterns[] = { SeedPattern::BlueNoise, SeedPattern::Jittered,
  SeedPattern::LowDiscrepancy, SeedPattern::Random };

} // namespace RectifiedTransport

#endif
