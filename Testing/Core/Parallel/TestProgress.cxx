// SPDX-License-Identifier: BSD-3-Clause
// Long work in slices: what is run, reported and thrown.
#include "Core/Device/DeviceUse.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Ranks.h"
#include "RecordingContext.h"
#include "TestSplat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace RectifiedTransport
{
namespace
{

const SerialExecutor serial;

constexpr std::int64_t count = 1000;
constexpr auto nothing = [](std::int64_t, std::int64_t) {};

TEST(Context, IsOfOpenMPOrOfAnExecutor)
{
  const Context usual;
  EXPECT_NE(dynamic_cast<const OpenMPExecutor*>(usual.Threads), nullptr);
  EXPECT_FALSE(usual.Report);
  EXPECT_FALSE(usual.IsCancelled);
  const Context context = serial;
  EXPECT_EQ(context.Threads, &serial);
  EXPECT_EQ(&Progress(serial).Threads(), &serial);
  EXPECT_EQ(&Progress(context).Threads(), &serial);
}

TEST(Progress, NeedsNoCallbacks)
{
  Progress progress(serial);
  progress.Expect(10);
  std::int64_t sum = 0;
  progress.For(
    count, 3, [&sum](std::int64_t first, std::int64_t last) { sum += last - first; }, 1);
  progress.Add(1 << 20);
  progress.Check();
  EXPECT_FALSE(progress.ShouldStop());
  EXPECT_FALSE(progress.IsCancelled());
  EXPECT_EQ(sum, count);
}

// Loops are all of the work, each of them, unless units are expected.
TEST(Progress, EachLoopIsAllOfTheWork)
{
  RecordingContext recorder(serial);
  Progress progress(recorder.Context());
  progress.For(count, 1, nothing, 1);
  EXPECT_GT(recorder.Reported.size(), 2u);
  recorder.ExpectReported(0.0, 1.0);
  progress.ForInOrder(count, 1, nothing, 1);
  recorder.ExpectReported(1.0, 1.0);
}

TEST(Progress, LoopsAddToExpectedUnits)
{
  RecordingContext recorder(serial);
  Progress progress(recorder.Context());
  EXPECT_EQ(&progress.Expect(4 * count), &progress);
  progress.For(count, 1, nothing, 1);
  EXPECT_GT(recorder.Reported.size(), 2u);
  recorder.ExpectReported(0.0, 0.25);
  progress.EndSlice(count);
  recorder.ExpectReported(0.25, 0.5);
  progress.ForInOrder(2 * count, 1, nothing, 1);
  recorder.ExpectReported(0.5, 1.0);
  progress.For(count, 1, nothing, 1); // more than was said
  recorder.ExpectReported(1.0, 1.0);
}

// A computation that reports to it is this work or a part of it.
TEST(Progress, IsAContext)
{
  RecordingContext recorder(serial);
  const SoloRanks ranks;
  DeviceUse device("none");
  Context given = recorder.Context();
  given.Group = &ranks;
  given.Device = &device;
  Progress outer(given);
  const Context context = outer;
  EXPECT_EQ(context.Threads, &serial);
  EXPECT_EQ(context.Group, &ranks);
  EXPECT_EQ(context.Device, &device);
  Progress inner(context);
  EXPECT_EQ(&inner.Threads(), &serial);
  EXPECT_EQ(&inner.Group(), &ranks);
  EXPECT_EQ(inner.Device(), &device);
  inner.Expect(4);
  inner.EndSlice(1);
  recorder.ExpectReported(0.25, 0.25);
  inner.EndSlice(3);
  recorder.ExpectReported(1.0, 1.0);
  // Both see the cancellation.
  recorder.MaximumQueries = 0;
  EXPECT_THROW(inner.Check(), Cancelled);
  EXPECT_THROW(outer.Check(), Cancelled);
}

TEST(Progress, NeverGoesBack)
{
  RecordingContext recorder(serial);
  Progress progress(recorder.Context());
  progress.Expect(2).EndSlice(1);
  recorder.ExpectReported(0.5, 0.5);
  progress.Expect(4).EndSlice(1);
  recorder.ExpectReported(0.5, 0.5);
  Progress inner{ Context(progress) };
  inner.Expect(4).EndSlice(1);
  recorder.ExpectReported(0.5, 0.5);
  inner.EndSlice(2);
  recorder.ExpectReported(0.75, 0.75);
  progress.EndSlice(1);
  recorder.ExpectReported(0.75, 0.75);
}

TEST(Progress, AddReportsInIntervals)
{
  RecordingContext recorder(serial);
  Progress progress(recorder.Context());
  constexpr std::int64_t total = 1000000;
  progress.Expect(total);
  for (std::int64_t i = 0; i < 1000; ++i)
  {
    progress.Add(1);
  }
  EXPECT_TRUE(recorder.Reported.empty());
  EXPECT_EQ(recorder.Queries, 0);
  for (std::int64_t i = 1000; i < total; ++i)
  {
    progress.Add(1);
  }
  EXPECT_EQ(recorder.Reported.size(), 15u); // 2^16 at a time
  EXPECT_EQ(recorder.Queries, 15);
  recorder.ExpectReported(0.0, 15.0 * 0x1p16 / total);
  // Work before that was not reported does not count.
  progress.Expect(total);
  progress.Add(0xffff);
  EXPECT_TRUE(recorder.Reported.empty());
  recorder.MaximumQueries = 0;
  EXPECT_THROW(progress.Add(1), Cancelled);
  EXPECT_EQ(recorder.Reported.size(), 1u);
}

// Every index once, in ranges cut at multiples of the grain, in slices that hold a range a thread.
TEST(Progress, ForRunsAll)
{
  for (const int concurrency : { 1, 4 })
  {
    const BackwardExecutor threads(concurrency);
    RecordingContext recorder(threads);
    Progress progress(recorder.Context());
    for (const std::int64_t grain : { 1, 7, 100, 5000 })
    {
      for (const std::int64_t units : { 1, 50, 100000 })
      {
        std::vector<int> visits(count, 0);
        progress.For(
          count, grain,
          [&](std::int64_t first, std::int64_t last) {
            EXPECT_EQ(first % grain, 0);
            EXPECT_TRUE(last % grain == 0 || last == count) << last;
            for (std::int64_t i = first; i < last; ++i)
            {
              ++visits[static_cast<std::size_t>(i)];
            }
          },
          units);
        EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), count);
      }
    }
    EXPECT_EQ(recorder.Reported.back(), 1.0);
    bool called = false;
    progress.For(0, 1, [&called](std::int64_t, std::int64_t) { called = true; });
    EXPECT_FALSE(called);
  }
}

TEST(Progress, ForThrowsWhatTheKernelThrows)
{
  const OpenMPExecutor threads;
  for (const Executor* executor :
    { static_cast<const Executor*>(&threads), static_cast<const Executor*>(&serial) })
  {
    RecordingContext recorder(*executor);
    Progress progress(recorder.Context());
    std::atomic<std::int64_t> last{ 0 };
    const auto kernel = [&last](std::int64_t first, std::int64_t end) {
      if (first >= 500)
      {
        throw std::bad_alloc();
      }
      last = std::max<std::int64_t>(last, end);
    };
    EXPECT_THROW(progress.For(count, 10, kernel, 1), std::bad_alloc);
    EXPECT_LE(last, 500);
    EXPECT_LE(recorder.Reported.back(), 0.5) << "reported what was not done";
    EXPECT_THROW(progress.ForInOrder(count, 10, kernel, 1), std::bad_alloc);
    EXPECT_FALSE(progress.IsCancelled());
  }
}

TEST(Progress, ForThrowsCancelled)
{
  const OpenMPExecutor threads;
  for (const bool inOrder : { false, true })
  {
    RecordingContext recorder(threads);
    recorder.MaximumQueries = 2;
    Progress progress(recorder.Context());
    std::atomic<std::int64_t> done{ 0 };
    const auto kernel = [&done](std::int64_t first, std::int64_t last) { done += last - first; };
    if (inOrder)
    {
      EXPECT_THROW(progress.ForInOrder(1 << 20, 1, kernel, 1), Cancelled);
    }
    else
    {
      EXPECT_THROW(progress.For(1 << 20, 1, kernel, 1), Cancelled);
    }
    EXPECT_EQ(recorder.Queries, 3);
    EXPECT_EQ(recorder.Reported.size(), 3u);
    EXPECT_LT(recorder.Reported.back(), 0.9) << "went on after it was cancelled";
    EXPECT_LT(done, 1 << 20);
    EXPECT_TRUE(progress.IsCancelled());
    // It stays cancelled.
    EXPECT_THROW(progress.EndSlice(1), Cancelled);
    EXPECT_THROW(progress.Check(), Cancelled);
  }
}

TEST(Progress, ForInOrderRunsHereInOrder)
{
  const OpenMPExecutor threads;
  Progress progress(threads);
  std::int64_t next = 0;
  const auto here = std::this_thread::get_id();
  progress.ForInOrder(
    count, 7,
    [&](std::int64_t first, std::int64_t last) {
      EXPECT_EQ(std::this_thread::get_id(), here);
      EXPECT_EQ(first, next);
      EXPECT_EQ(first % 7, 0);
      next = last;
    },
    1);
  EXPECT_EQ(next, count);
}

TEST(Progress, SlicesAreMultiplesOfTheSmallest)
{
  Progress progress(serial);
  progress.Expect(1 << 20);
  EXPECT_EQ(progress.NextSlice(24), 24);
  std::int64_t slice = 24;
  for (int i = 0; i < 50; ++i)
  {
    progress.EndSlice(slice);
    const std::int64_t next = progress.NextSlice(24);
    EXPECT_GE(next, 24);
    EXPECT_EQ(next % 24, 0);
    EXPECT_LE(next, 4 * slice + 24); // a slice may be the first that is slow
    slice = next;
  }
  EXPECT_GT(slice, 24); // work of no time
  progress.Expect(1 << 20);
  EXPECT_EQ(progress.NextSlice(24), 24);
}

TEST(Progress, CheckThrows)
{
  RecordingContext recorder(serial);
  recorder.MaximumQueries = 2;
  Progress progress(recorder.Context());
  EXPECT_NO_THROW(progress.Check());
  EXPECT_NO_THROW(progress.Check());
  EXPECT_FALSE(progress.IsCancelled());
  EXPECT_THROW(progress.Check(), Cancelled);
  EXPECT_TRUE(progress.IsCancelled());
  EXPECT_TRUE(recorder.Reported.empty());
}

// Many threads call ShouldStop, but IsCancelled is called by one at a time.
TEST(Progress, ManyThreadsMayQuery)
{
  const OpenMPExecutor executor;
  RecordingContext recorder(executor);
  recorder.MaximumQueries = 1000;
  Progress progress(recorder.Context());
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
  {
    threads.emplace_back([&progress]() {
      while (!progress.ShouldStop())
      {
      }
    });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_GT(recorder.Queries, 1000);
  EXPECT_LE(recorder.Queries, 1004); // each of the others once more
  EXPECT_THROW(progress.EndSlice(1), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
