// SPDX-License-Identifier: BSD-3-Clause
// Sums and other reductions over fixed chunks, so that they have the same bits on any number of
// threads.
#ifndef RectifiedTransport_Reduction_h
#define RectifiedTransport_Reduction_h

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <vector>

namespace RectifiedTransport
{

// Calls kernel(first, last), which returns a Part, once for each chunk of `grain` of [0, count), on
// the progress's threads. Returns combine(combine(nothing, part), part)... of the parts in the
// order of the chunks, `nothing` if there are none. The first slice has `units`, as in
// Progress::For. Memory: a Part a chunk. Throws std::bad_alloc, Cancelled, and what the kernel
// throws.
template <class Part, class Kernel, class Combine>
Part reduceChunks(Progress& progress, std::int64_t count, std::int64_t grain, const Part& nothing,
  const Kernel& kernel, const Combine& combine, std::int64_t units = std::int64_t{ 1 } << 18)
{
  static_assert(!std::is_same_v<Part, bool>, "threads write to bits of one word");
  std::vector<Part> parts(static_cast<std::size_t>((count + grain - 1) / grain), nothing);
  progress.For(
    count, grain,
    [&](std::int64_t first, std::int64_t last) {
      // Ranges may hold several times the grain.
      for (std::int64_t begin = first; begin < last; begin += grain)
      {
        parts[static_cast<std::size_t>(begin / grain)] =
          kernel(begin, std::min(begin + grain, last));
      }
    },
    units);
  Part all = nothing;
  for (const Part& part : parts)
  {
    all = combine(all, part);
  }
  return all;
}

// The same where visit(i, part) adds number i to the part of its chunk, which begins as `nothing`.
template <class Part, class Visit, class Combine>
Part reduceEach(Progress& progress, std::int64_t count, std::int64_t grain, const Part& nothing,
  const Visit& visit, const Combine& combine)
{
  return reduceChunks(
    progress, count, grain, nothing,
    [&](std::int64_t first, std::int64_t last) {
      Part part = nothing;
      for (std::int64_t i = first; i < last; ++i)
      {
        visit(i, part);
      }
      return part;
    },
    combine);
}

// The sum of term(i) of [0, count), which are added one after another in each chunk. As
// reduceChunks.
template <class Term>
double sumTerms(Progress& progress, std::int64_t count, std::int64_t grain, const Term& term)
{
  return reduceEach(
    progress, count, grain, 0.0, [&term](std::int64_t i, double& sum) { sum += term(i); },
    std::plus<>());
}

} // namespace RectifiedTransport

#endif
