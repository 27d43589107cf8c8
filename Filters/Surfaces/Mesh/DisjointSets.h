// SPDX-License-Identifier: BSD-3-Clause
// Disjoint sets of numbers: the parent of each number is another number of its set, or itself.
#ifndef RectifiedTransport_DisjointSets_h
#define RectifiedTransport_DisjointSets_h

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// The number of a set that is its own parent. Halves the way there.
inline std::int64_t rootOf(std::int64_t* parents, std::int64_t number)
{
  while (parents[number] != number)
  {
    parents[number] = parents[parents[number]];
    number = parents[number];
  }
  return number;
}

// Joins the sets of two numbers; the lower root becomes the root.
inline void uniteSets(std::int64_t* parents, std::int64_t a, std::int64_t b)
{
  a = rootOf(parents, a);
  b = rootOf(parents, b);
  parents[std::max(a, b)] = std::min(a, b);
}

} // namespace RectifiedTransport

#endif
