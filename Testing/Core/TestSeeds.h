// SPDX-License-Identifier: BSD-3-Clause
// What the tests of seeds share.
#ifndef RectifiedTransport_TestSeeds_h
#define RectifiedTransport_TestSeeds_h

#include "Core/Seeds/Seeds.h"
#include "TestDensities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
std::vector<double> seeds(SeedPattern pattern, const Point<Dimension>& lengths, std::int64_t count,
  std::uint64_t randomSeed)
{
  std::vector<double> points(count * Dimension);
  generateSeeds<Dimension>(pattern, lengths, randomSeed, { points.data(), count });
  return points;
}

} // namespace RectifiedTransport

#endif
