// SPDX-License-Identifier: BSD-3-Clause
// OpenMP's executor: many short loops, loops of several threads and within one another, children of
// fork(), and loops that are too short for other threads.
#include "Core/Parallel/Forks.h"
#include "Core/Parallel/Progress.h"
#include "CountingExecutor.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <atomic>
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

TEST(LoopTeam, IsNotCalledForShortSlices)
{
  const CountingExecutor executor;
  Progress progress(executor);
  progress.BeginStage(1.0);
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
#endif

} // namespace
} // namespace RectifiedTransport
