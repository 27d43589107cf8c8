// SPDX-License-Identifier: BSD-3-Clause
// Stable sorting of long sequences, with polls for cancellation.
#ifndef RectifiedTransport_KeySort_h
#define RectifiedTransport_KeySort_h

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

// By their member Key, ascending. Throws std::bad_alloc and Cancelled.
template <class Keyed>
void sortByKey(std::vector<Keyed>& elements, Progress& progress)
{
  constexpr std::size_t shortest = std::size_t{ 1 } << 16; // sorted at once
  const auto isLess = [](const Keyed& a, const Keyed& b) { return a.Key < b.Key; };
  const auto at = [&](std::size_t place) {
    return elements.begin() + static_cast<std::ptrdiff_t>(std::min(place, elements.size()));
  };
  for (std::size_t first = 0; first < elements.size(); first += shortest)
  {
    if (!std::is_sorted(at(first), at(first + shortest), isLess))
    {
      std::stable_sort(at(first), at(first + shortest), isLess);
    }
    progress.Check();
  }
  for (std::size_t width = shortest; width < elements.size(); width *= 2)
  {
    for (std::size_t first = 0; first + width < elements.size(); first += 2 * width)
    {
      if (isLess(*at(first + width), *(at(first + width) - 1)))
      {
        std::inplace_merge(at(first), at(first + width), at(first + 2 * width), isLess);
      }
      progress.Check();
    }
  }
}

} // namespace RectifiedTransport

#endif
