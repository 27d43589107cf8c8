// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/Cartogram.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace RectifiedTransport
{

std::int32_t raiseMasses(std::vector<double>& masses, double leastShare)
{
  const double equal =
    std::accumulate(masses.begin(), masses.end(), 0.0) / static_cast<double>(masses.size());
  // A least share of 1 / n leaves only equal masses.
  if (leastShare * static_cast<double>(masses.size()) >= 1.0)
  {
    const auto raised =
      std::count_if(masses.begin(), masses.end(), [equal](double mass) { return mass < equal; });
    std::fill(masses.begin(), masses.end(), equal);
    return static_cast<std::int32_t>(raised);
  }
  std::vector<unsigned char> isRaised(masses.size(), 0);
  std::int32_t count = 0;
  for (;;)
  {
    double others = 0.0;
    for (std::size_t i = 0; i < masses.size(); ++i)
    {
      others += isRaised[i] != 0 ? 0.0 : masses[i];
    }
    // Raised masses m satisfy m = s (others + count m), so m = s * others / (1 - s * count).
    // Raising lowers the share of the others, which may fall below s in turn; so the search
    // repeats.
    const double least = leastShare * others / (1.0 - leastShare * count);
    const std::int32_t before = count;
    for (std::size_t i = 0; i < masses.size(); ++i)
    {
      const bool isLess = isRaised[i] == 0 && masses[i] < least;
      isRaised[i] = isRaised[i] != 0 || isLess;
      count += isLess ? 1 : 0;
    }
    for (std::size_t i = 0; count == before && i < masses.size(); ++i)
    {
      masses[i] = isRaised[i] != 0 ? least : masses[i];
    }
    if (count == before)
    {
      return count;
    }
  }
}

} // namespace RectifiedTransport
