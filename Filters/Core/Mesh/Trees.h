// SPDX-License-Identifier: BSD-3-Clause
// Disjoint sets of numbers: each number has another one of its set for its parent, or itself.
#ifndef RectifiedTransport_Trees_h
#define RectifiedTransport_Trees_h

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

// Makes the sets of two numbers one, whose root is the lower one of both.
inline void joinTrees(std::int64_t* parents, std::int64_t a, std::int64_t b)
{
  a = rootOf(parents, a);
  b = rootOf(parents, b);
  parents[std::max(a, b)] = std::min(a, b);
}

} // namespace RectifiedTransport

#endif
