// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/LoopTeam.h"

#include <algorithm>
#include <cfenv>
#include <exception>
#include <thread>

#include <omp.h>

namespace RectifiedTransport
{

namespace
{

// Spins for some ten microseconds until something comes, which is faster than to sleep if it comes
// at once. Returns whether it came.
template <class Test>
bool spin(const Test& hasCome)
{
  constexpr int turns = 400;
  for (int turn = 0; turn < turns; ++turn)
  {
    if (hasCome())
    {
      return true;
    }
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ __volatile__("yield");
#endif
  }
  return hasCome();
}

} // namespace

// One parallel loop. Its ranges are numbers that threads take one after the other, so that fast
// threads take more of them.
class LoopTeam::Loop
{
public:
  Loop(int threads, std::int64_t count, std::int64_t grain, const RangeKernel& kernel)
    : Places(threads - 1)
    , Count(count)
    , Grain(grain)
    , Kernel(kernel)
  {
    // The caller's rounding mode and exceptions hold on all threads.
    std::fegetenv(&this->Arithmetic);
  }

  // Runs ranges that no other thread has begun, until there are none.
  void Work()
  {
    const std::int64_t ranges = (this->Count + this->Grain - 1) / this->Grain;
    for (std::int64_t range = this->Next++; range < ranges && !this->Failure.HasHappened();
         range = this->Next++)
    {
      try
      {
        this->Kernel(range * this->Grain, std::min((range + 1) * this->Grain, this->Count));
      }
      catch (...)
      {
        this->Failure.Keep();
      }
    }
  }

  // The same on another thread, in the caller's floating-point environment.
  void Help()
  {
    std::fesetenv(&this->Arithmetic);
    this->Work();
  }

  int Places; // for helpers, guarded by the team's mutex
  // The threads that have joined and not left: the loop is on the caller's stack until it is 0.
  std::atomic<int> Inside{ 0 };
  Loop* Following = nullptr;
  KernelFailure Failure;

private:
  const std::int64_t Count;
  const std::int64_t Grain;
  const RangeKernel& Kernel;
  std::fenv_t Arithmetic; // the caller's floating-point environment
  std::atomic<std::int64_t> Next{ 0 };
};

LoopTeam& LoopTeam::Get()
{
  // Its threads last as long as the process.
  static LoopTeam* const team = new LoopTeam;
  return *team;
}

// The caller puts the loop on a list where threads of the team join it, works itself, and returns
// when all have left it. Kernels may run loops of their own: those are further entries of the list.
void LoopTeam::Run(int threads, std::int64_t count, std::int64_t grain, const RangeKernel& kernel)
{
  Loop loop(threads, count, grain, kernel);
  const std::int64_t helpers = std::min<std::int64_t>(threads, (count + grain - 1) / grain) - 1;
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Grow(threads, lock);
    loop.Following = this->First;
    this->First = &loop;
    ++this->Changes;
  }
  for (std::int64_t helper = 0; helper < helpers; ++helper)
  {
    this->Begun.notify_one();
  }
  loop.Work();
  // No thread joins any more; those inside finish their ranges.
  this->Remove(loop);
  const auto isLeft = [&loop]() { return loop.Inside.load(std::memory_order_acquire) == 0; };
  if (!spin(isLeft))
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Left.wait(lock, isLeft);
  }
  // The first exception of any thread's kernel goes to the caller.
  loop.Failure.Rethrow();
}

// Adds threads by a further parallel region, so that nobody waits for loops that run: their kernels
// may wait for what the caller holds. Returns when the threads are there: OpenMP ends the program
// where memory is too short for them, which is no surprise at the first loop.
void LoopTeam::Grow(int threads, std::unique_lock<std::mutex>& lock)
{
  if (threads <= this->Size)
  {
    return;
  }
  try
  {
    std::thread(&LoopTeam::Host, this, threads - this->Size).detach();
  }
  catch (const std::exception&)
  {
    return; // this loop runs on those that there are
  }
  this->Size = threads;
  this->Grown.wait(lock, [&]() { return this->Started >= threads; });
}

// A thread of its own opens the region and keeps it open, as OpenMP's threads exist for the time of
// a region.
void LoopTeam::Host(int more)
{
#pragma omp parallel num_threads(more + 1)
  if (omp_get_thread_num() == 0)
  {
    // It has the place of a thread that calls.
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Started += more;
    this->Grown.notify_all();
    this->Never.wait(lock, []() { return false; });
  }
  else
  {
    this->Serve();
  }
}

// The life of a thread of the team: joins loops while there are any, spins for a while, then sleeps
// until the list changes.
void LoopTeam::Serve()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  for (;;)
  {
    const unsigned seen = this->Changes;
    if (Loop* loop = this->Join())
    {
      lock.unlock();
      loop->Help();
      lock.lock();
      if (--loop->Inside == 0)
      {
        this->Left.notify_all();
      }
      continue;
    }
    const auto hasChanged = [&]() { return this->Changes.load(std::memory_order_relaxed) != seen; };
    lock.unlock();
    const bool isSoon = spin(hasChanged);
    lock.lock();
    if (!isSoon)
    {
      this->Begun.wait(lock, hasChanged);
    }
  }
}

// The latest loop first: inner loops are short, and outer ones wait for them.
LoopTeam::Loop* LoopTeam::Join()
{
  for (Loop* loop = this->First; loop; loop = loop->Following)
  {
    if (loop->Places > 0)
    {
      --loop->Places;
      ++loop->Inside;
      return loop;
    }
  }
  return nullptr;
}

// Takes a loop off the list, wherever it is by now.
void LoopTeam::Remove(Loop& loop)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  Loop** place = &this->First;
  while (*place != &loop)
  {
    place = &(*place)->Following;
  }
  *place = loop.Following;
}

} // namespace RectifiedTransport
