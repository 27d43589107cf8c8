// SPDX-License-Identifier: BSD-3-Clause
// An order of distributed elements, and sums in that order, bitwise as in one process.
#ifndef RectifiedTransport_RankOrder_h
#define RectifiedTransport_RankOrder_h

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace RectifiedTransport
{

// The order is that of keys; equal keys, and elements without keys, are ordered by rank, then by
// index. Every rank has a share of consecutive elements; shares ascend with the ranks. The members
// are collective. Memory: 16 bytes for each element that a rank gives or gets, and during
// construction 40 more, if keys are spread about evenly between the smallest and the largest one.
class RankOrder
{
public:
  // For this rank's `count` elements. Keys may be null, on all ranks that have elements. Shares are
  // whole chunks of `grain` elements, except the last chunk of all. Throws std::bad_alloc and
  // Cancelled.
  RankOrder(std::int64_t count, const std::int64_t* keys, std::int64_t grain, const Ranks& ranks,
    Progress& progress);

  // The elements of this rank's share.
  std::int64_t Count() const { return this->ShareCount; }
  // The values of this rank's share in order, from the values valueOf(i) of this rank's elements.
  template <class ValueOf>
  auto Redistribute(const ValueOf& valueOf) const
  {
    using T = std::decay_t<decltype(valueOf(std::int64_t{ 0 }))>;
    std::vector<T> values(static_cast<std::size_t>(this->ShareCount));
    std::vector<std::size_t> taken(this->Slots.size());
    exchangeInRounds(
      this->Group, static_cast<std::int64_t>(this->Receiver.size()),
      [this](std::int64_t i) { return this->Receiver[static_cast<std::size_t>(i)]; }, valueOf,
      [&](std::size_t rank, const T& value) {
        const std::int64_t slot = this->Slots[rank][taken[rank]++];
        values[static_cast<std::size_t>(slot)] = value;
      });
    return values;
  }

private:
  const Ranks& Group;
  std::vector<int> Receiver;                    // of each element
  std::vector<std::vector<std::int64_t>> Slots; // in the share, of what each rank sends
  std::int64_t ShareCount = 0;
};

// Sums whose terms are added one after another, rank 0 first: add(sums) adds the terms of this
// rank. Collective.
template <class Sums, class Add>
Sums sumInTurn(const Ranks& ranks, Sums sums, const Add& add)
{
  for (int rank = 0; rank < ranks.Count(); ++rank)
  {
    if (rank == ranks.Own())
    {
      add(sums);
    }
    sums = gatherValues(ranks, sums)[static_cast<std::size_t>(rank)];
  }
  return sums;
}

// As reduceChunks: the sum of the sums of chunks of `grain` values. Each rank gives whole chunks;
// only the last chunk of the last rank with values may be shorter. Collective.
inline double sumChunks(
  const double* values, std::int64_t count, std::int64_t grain, const Ranks& ranks)
{
  std::vector<double> sums;
  for (std::int64_t first = 0; first < count; first += grain)
  {
    double sum = 0.0;
    for (std::int64_t i = first; i < std::min(first + grain, count); ++i)
    {
      sum += values[i];
    }
    sums.push_back(sum);
  }
  double all = 0.0;
  for (const Bytes& bytes : ranks.Gather(toBytes(sums)))
  {
    for (const double sum : fromBytes<double>(bytes))
    {
      all += sum;
    }
  }
  return all;
}

} // namespace RectifiedTransport

#endif
