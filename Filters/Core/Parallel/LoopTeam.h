// SPDX-License-Identifier: BSD-3-Clause
// OpenMP's threads for one loop after another, beside other programs too.
#ifndef RectifiedTransport_LoopTeam_h
#define RectifiedTransport_LoopTeam_h

#include "Core/Parallel/Executor.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace RectifiedTransport
{

// At the end of a parallel region OpenMP's threads wait for each other, and then for the next
// region, by spinning for milliseconds. Where other programs keep the processors busy, a thread
// that spins takes the time of the one that it waits for, and a loop of microseconds takes
// milliseconds. Hence all loops of this process run in regions that last, usually one: its threads
// sleep between loops, and a loop waits only for those that have begun a range of it.
class LoopTeam
{
public:
  static LoopTeam& Get();

  // Runs the ranges on the calling thread, and on `threads` - 1 others as they find the time. What
  // a kernel throws comes out. On all threads, arithmetic rounds and treats subnormal numbers as it
  // does on the calling one.
  void Run(int threads, std::int64_t count, std::int64_t grain, const RangeKernel& kernel);

private:
  class Loop;

  LoopTeam() = default;
  void Grow(int threads, std::unique_lock<std::mutex>& lock);
  void Host(int more);
  void Serve();
  Loop* Join();
  void Remove(Loop& loop);

  // The mutex guards all that follows it.
  std::mutex Mutex;
  std::condition_variable Begun; // a loop
  std::condition_variable Grown;
  std::condition_variable Left; // a loop, by its last thread
  std::condition_variable Never;
  Loop* First = nullptr; // the list of loops that threads may join
  // Counts loops; those that spin read it.
  std::atomic<unsigned> Changes{ 0 };
  // How many threads there are to be, and are, with the one that calls.
  int Size = 1;
  int Started = 1;
};

} // namespace RectifiedTransport

#endif
