// SPDX-License-Identifier: BSD-3-Clause
// Sums of doubles that do not depend on the order of the terms: the same bits however terms are
// divided among threads, parts and processes.
#ifndef RectifiedTransport_ExactSum_h
#define RectifiedTransport_ExactSum_h

#include "Progress.h"

#include <array>
#include <cstdint>
#include <mutex>

namespace RectifiedTransport
{

// All bits of a sum, in overlapping words of 32 bits each (after the "small superaccumulator" of
// Neal 2015, arXiv:1505.05571). Trivially copyable, to be sent to other processes.
class ExactSum
{
public:
  // Up to 2^30 terms and sums, in all, between two merges.
  void Add(double term);
  void Add(const ExactSum& other);
  // The sum, rounded once; infinite or NaN if the sum of the terms is.
  double Value() const;

private:
  static constexpr int WordBits = 32;
  static constexpr int Words = 68; // from 2^-1074 on, to more than 2^1024 times 2^30
  void Carry();

  std::array<std::int64_t, Words> Word{};
  double NotFinite = 0.0;
  std::int64_t Terms = 0; // since the last carry
};

// The sum over [0, count) of what kernel(first, last, sum) adds for its ranges, on the progress's
// threads. Sum has Add(const Sum&).
template <class Sum, class Kernel>
Sum sumExactly(Progress& progress, std::int64_t count, std::int64_t grain, const Kernel& kernel)
{
  Sum all;
  std::mutex mutex;
  progress.For(count, grain, [&](std::int64_t first, std::int64_t last) {
    Sum part;
    kernel(first, last, part);
    const std::lock_guard<std::mutex> lock(mutex);
    all.Add(part);
  });
  return all;
}

} // namespace RectifiedTransport

#endif
