// SPDX-License-Identifier: BSD-3-Clause
// Sums by several threads that have the same bits for every number of threads: terms are rounded to
// 64-bit integers, so that the order of the additions does not matter.
#ifndef RectifiedTransport_IntegerSums_h
#define RectifiedTransport_IntegerSums_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// What 1 is as an integer. Sums of magnitudes up to 1 cannot overflow, whatever is lost to
// rounding.
constexpr double integerUnit = 0x1p62;

// Rounds the product of a term and integerUnit.
inline std::int64_t toInteger(double scaled)
{
  return static_cast<std::int64_t>(scaled + (scaled < 0.0 ? -0.5 : 0.5));
}

// Arrays take 8 bytes a sum and thread, so that more of them cost more than waiting does.
constexpr int mostArraysOfSums = 8;

// Integer additions commute, unlike those of floats.
class IntegerSums
{
public:
  // `count` sums, which begin at 0, in an array for each thread that adds at one time: more than
  // one only if the number of terms is worth it.
  IntegerSums(std::int64_t count, std::int64_t terms, const Progress& progress)
    : Count(count)
    , Most(ArraysFor(count, terms, progress.Threads().Concurrency()))
  {
  }

  // The number of arrays: clearing and adding up an array must be little beside its terms.
  static int ArraysFor(std::int64_t count, std::int64_t terms, int threads)
  {
    const std::int64_t most = std::clamp(threads, 1, mostArraysOfSums);
    return static_cast<int>(std::min(1 + 4 * terms / count, most));
  }

  // What one thread adds to, while it exists. Others wait where all arrays are taken. Throws
  // std::bad_alloc.
  class Part
  {
  public:
    explicit Part(IntegerSums& sums)
      : Sums(sums)
      , Own(sums.Take())
    {
    }
    ~Part() { this->Sums.Recycle(this->Own); }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

    // The array of this part; the thread adds to it without locks.
    std::int64_t* Values() const { return this->Own; }

  private:
    IntegerSums& Sums;
    std::int64_t* const Own;
  };

  // Calls visit(i, sum) and sets the sums to 0; no thread has a part then. Adds `count` units of
  // work. Throws Cancelled.
  template <class Visit>
  void Finish(Progress& progress, const Visit& visit)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
    progress.ForEach(this->Count, grain, [&](std::int64_t i) {
      std::int64_t sum = 0;
      for (LargeBuffer<std::int64_t>& array : this->Arrays)
      {
        sum += array.data()[i];
        array.data()[i] = 0;
      }
      visit(i, sum);
    });
  }
  // Adds the arrays up into the first one, returns it and keeps none.
  LargeBuffer<std::int64_t> Release(Progress& progress)
  {
    if (this->Arrays.empty())
    {
      const Part none(*this);
    }
    for (std::size_t i = 1; i < this->Arrays.size(); ++i)
    {
      constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
      std::int64_t* all = this->Arrays.front().data();
      const std::int64_t* more = this->Arrays[i].data();
      progress.Threads().For(this->Count, grain, [=](std::int64_t first, std::int64_t last) {
        for (std::int64_t j = first; j < last; ++j)
        {
          all[j] += more[j];
        }
      });
      progress.Check();
    }
    LargeBuffer<std::int64_t> sums = std::move(this->Arrays.front());
    this->Arrays.clear();
    this->Free.clear();
    return sums;
  }

private:
  // A free array, or a new one while there are fewer than Most.
  std::int64_t* Take()
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    if (this->Free.empty() && this->Arrays.size() < static_cast<std::size_t>(this->Most))
    {
      LargeBuffer<std::int64_t> made(this->Count);
      std::fill_n(made.data(), this->Count, 0);
      this->Free.reserve(static_cast<std::size_t>(this->Most)); // Recycle does not throw
      this->Arrays.reserve(static_cast<std::size_t>(this->Most));
      this->Free.push_back(made.data());
      this->Arrays.push_back(std::move(made));
    }
    this->Returned.wait(lock, [this]() { return !this->Free.empty(); });
    std::int64_t* values = this->Free.back();
    this->Free.pop_back();
    return values;
  }
  void Recycle(std::int64_t* values)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Free.push_back(values);
    this->Returned.notify_one();
  }

  const std::int64_t Count;
  const int Most;
  // Values of all arrays, and those that no part has.
  std::vector<LargeBuffer<std::int64_t>> Arrays;
  std::vector<std::int64_t*> Free;
  std::mutex Mutex;
  std::condition_variable Returned;
};

} // namespace RectifiedTransport

#endif
