// SPDX-License-Identifier: BSD-3-Clause
// The properties SeedPattern of particles and Pattern of seeds.
#ifndef RectifiedTransport_SeedSettings_h
#define RectifiedTransport_SeedSettings_h

#include "Core/Messages/PropertyCheck.h"
#include "Core/Seeds/Seeds.h"

namespace RectifiedTransport::Bridge
{

constexpr const char* SeedPatternTexts[] = { "BlueNoise", "Lattice", "Jittered", "LowDiscrepancy",
  "Random" };

// Throws Failure, which names the property, for a value out of range.
inline SeedPattern seedPattern(const char* property, int pattern)
{
  requireChoice(property, pattern, SeedPatternTexts);
  return static_cast<SeedPattern>(pattern);
}

} // namespace RectifiedTransport::Bridge

#endif
