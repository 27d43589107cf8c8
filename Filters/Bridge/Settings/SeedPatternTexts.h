// SPDX-License-Identifier: BSD-3-Clause
// The names of the values of a pattern property.
#ifndef RectifiedTransport_SeedPatternTexts_h
#define RectifiedTransport_SeedPatternTexts_h

namespace RectifiedTransport
{

// By SeedPattern.
constexpr const char* SeedPatternTexts[] = { "BlueNoise", "Lattice", "Jittered", "LowDiscrepancy",
  "Random" };

} // namespace RectifiedTransport

#endif
