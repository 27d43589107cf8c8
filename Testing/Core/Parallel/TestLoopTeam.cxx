// SPDX-License-Identifier: BSD-3-Clause
// OpenMP's executor: many short loops, loops of several threads and within one another, what they
// throw, growth meanwhile, arithmetic, children of fork(), and loops that are too short for other
// threads.
#include "Core/Parallel/Forks.h"
#include "Core/Parallel/Progress.h"
#include "CountingExecutor.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace RectifiedTransport
{
namespace
{

// The sum of squares, by a loop over parts of it.
std::int64_t sumOfSquares(const Executor& executor, std::int64_t count, std::int64_t grain)
{
  std::vector<std::int64_t> squares(static_cast<std::size_t>(count), -1);
  executor.For(count, grain, [&](std::int64_t first, std::int64_t last) {
    EXPECT_EQ(first % grain, 0);
    for (std::int64_t i = first; i < last; ++i)
    {
      squares[static_cast<std::size_t>(i)] = i * i;
    }
  });
  return std::accumulate(squares.begin(), squares.end(), std::int64_t{ 0 });
}

constexpr std::int64_t expected(std::int64_t count)
{
  return (count - 1) * count * (2 * count - 1) / 6;
}

TEST(LoopTeam, RunsShortLoopsOneAfterTheOther)
{
  for (const int threads : { 2, 3, 1, 4, 2 })
  {
    const ThreadsExecutor executor(threads);
    for (std::int64_t count = 1; count < 400; ++count)
    {
      ASSERT_EQ(sumOfSquares(executor, count, 1 + count % 7), expected(count));
    }
  }
}

TEST(LoopTeam, RunsLoopsOfSeveralThreadsAndWithinLoops)
{
  std::atomic<int> wrong{ 0 };
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 3; ++caller)
  {
    callers.emplace_back([&wrong]() {
      const ThreadsExecutor executor(3);
      for (int loop = 0; loop < 100; ++loop)
      {
        executor.For(5, 1, [&](std::int64_t first, std::int64_t) {
          wrong += sumOfSquares(executor, 50 + first, 4) == expected(50 + first) ? 0 : 1;
        });
      }
    });
  }
  for (std::thread& caller : callers)
  {
    caller.join();
  }
  EXPECT_EQ(wrong, 0);
}

// Waits for what other threads do. Returns whether they did it.
template <class Test>
bool comes(const Test& test)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!test())
  {
    if (std::chrono::steady_clock::now() > end)
    {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return true;
}

TEST(LoopTeam, ThrowsWhatItsOwnKernelThrew)
{
  std::atomic<int> wrong{ 0 };
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 3; ++caller)
  {
    callers.emplace_back([caller, &wrong]() {
      const ThreadsExecutor executor(3);
      for (int loop = 0; loop < 300; ++loop)
      {
        const bool throws = loop % 2 == 0;
        try
        {
          executor.For(20, 1, [=](std::int64_t first, std::int64_t) {
            if (throws && first % 4 == 3)
            {
              throw caller;
            }
          });
          wrong += throws ? 1 : 0;
        }
        catch (const int thrown)
        {
          wrong += throws && thrown == caller ? 0 : 1;
        }
      }
    });
  }
  for (std::thread& caller : callers)
  {
    caller.join();
  }
  EXPECT_EQ(wrong, 0);
}

#ifdef _OPENMP
// What its kernel waits for may need a loop on more threads.
TEST(LoopTeam, GrowsWhileALoopRuns)
{
  std::atomic<int> begun{ 0 };
  std::atomic<bool> hasGrown{ false };
  std::thread caller([&]() {
    ThreadsExecutor(2).For(2, 1, [&](std::int64_t, std::int64_t) {
      ++begun;
      EXPECT_TRUE(comes([&]() { return hasGrown.load(); }));
    });
  });
  EXPECT_TRUE(comes([&]() { return begun == 2; }));
  EXPECT_EQ(sumOfSquares(ThreadsExecutor(13), 1000, 10), expected(1000));
  hasGrown = true;
  caller.join();
}

// Libraries of other compilers set subnormal numbers to zero on the thread that loads them. The
// bits are the same on all threads nevertheless.
TEST(LoopTeam, RoundsAsTheCallingThreadDoes)
{
  const int before = std::fegetround();
  for (const int rounding : { FE_UPWARD, FE_TONEAREST, FE_DOWNWARD })
  {
    std::fesetround(rounding);
    std::atomic<int> begun{ 0 };
    std::atomic<int> wrong{ 0 };
    ThreadsExecutor(2).For(2, 1, [&](std::int64_t, std::int64_t) {
      ++begun;
      EXPECT_TRUE(comes([&]() { return begun == 2; }));
      wrong += std::fegetround() == rounding ? 0 : 1;
    });
    EXPECT_EQ(wrong, 0);
  }
  std::fesetround(before);
}
#endif

TEST(LoopTeam, IsNotCalledForShortSlices)
{
  const CountingExecutor executor;
  Progress progress(executor);
  std::int64_t done = 0;
  const auto kernel = [&done](std::int64_t first, std::int64_t last) { done += last - first; };
  progress.For(15, 1, kernel, 1024);
  EXPECT_EQ(executor.Calls, 0);
  progress.For(16, 1, kernel, 1024);
  EXPECT_EQ(executor.Calls, 1);
  progress.For(1000, 8, kernel); // of the usual work, which is in memory
  EXPECT_EQ(executor.Calls, 1);
  progress.For(10000, 8, kernel);
  EXPECT_EQ(executor.Calls, 2);
  EXPECT_EQ(done, 15 + 16 + 1000 + 10000);
}

#ifndef _WIN32
// A child has none of the threads that its parent has.
TEST(LoopTeam, RunsSeriallyInAChildOfFork)
{
  const ThreadsExecutor executor(2);
  ASSERT_EQ(sumOfSquares(executor, 1000, 10), expected(1000));
  EXPECT_EQ(forksSinceLoad(), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
  {
    alarm(20); // ends it if it hangs
    const bool isRight = sumOfSquares(executor, 1000, 10) == expected(1000) &&
      OpenMPExecutor().Concurrency() == 1 && forksSinceLoad() == 1;
    _exit(isRight ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(forksSinceLoad(), 0);
  EXPECT_EQ(sumOfSquares(executor, 1000, 10), expected(1000));
}

// Whatever the parent's threads do at that moment.
TEST(LoopTeam, RunsInAChildThatForksWhileLoopsRun)
{
  std::atomic<bool> ends{ false };
  std::thread caller([&ends]() {
    while (!ends)
    {
      sumOfSquares(ThreadsExecutor(3), 100, 1);
    }
  });
  for (int turn = 0; turn < 20; ++turn)
  {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0)
    {
      alarm(20);
      std::int64_t sum = 0;
      ThreadsExecutor(3).For(
        100, 7, [&sum](std::int64_t first, std::int64_t last) { sum += last - first; });
      _exit(sum == 100 ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  ends = true;
  caller.join();
}
#endif

} // namespace
} // namespace RectifiedTransport
