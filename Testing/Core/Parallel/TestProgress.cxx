// SPDX-License-Identifier: BSD-3-Clause
// Stages of long work, within one another, and its slices: what is run, reported and thrown.
#include "Core/Parallel/Progress.h"
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

// A host that notes what it hears, and says stop after it was asked so often.
class Host
{
public:
  explicit Host(const Executor& threads = serial)
    : Threads(threads)
  {
  }

  RectifiedTransport::Context Context()
  {
    return { this->Threads,
      [this](double fraction) {
        EXPECT_EQ(std::this_thread::get_id(), this->Thread) << "heard on another thread";
        this->Heard.push_back(fraction);
      },
      [this]() {
        EXPECT_FALSE(this->IsAsked.exchange(true)) << "asked by two at a time";
        const bool stop = ++this->Asked > this->Patience;
        this->IsAsked = false;
        return stop;
      } };
  }

  // Since the last time; they ascend from `low` to `high`.
  void ExpectHeard(double low, double high)
  {
    ASSERT_FALSE(this->Heard.empty());
    EXPECT_TRUE(std::is_sorted(this->Heard.begin(), this->Heard.end()));
    EXPECT_GE(this->Heard.front(), low);
    EXPECT_NEAR(this->Heard.back(), high, 1e-15);
    this->Heard.clear();
  }

  std::vector<double> Heard;
  std::atomic<int> Asked{ 0 };
  int Patience = 1 << 30;

private:
  const Executor& Threads;
  const std::thread::id Thread = std::this_thread::get_id();
  std::atomic<bool> IsAsked{ false };
};

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

TEST(Progress, NeedsNoHost)
{
  Progress progress(serial);
  progress.BeginStage(1.0, 10);
  std::int64_t sum = 0;
  progress.For(
    count, 3, [&sum](std::int64_t first, std::int64_t last) { sum += last - first; }, 1);
  progress.Add(1 << 20);
  progress.Check();
  EXPECT_FALSE(progress.ShouldStop());
  EXPECT_FALSE(progress.IsCancelled());
  EXPECT_EQ(sum, count);
}

TEST(Progress, StagesFollow)
{
  Host host;
  Progress progress(host.Context());
  progress.BeginStage(0.25);
  EXPECT_EQ(progress.StageEnd(), 0.25);
  progress.For(count, 1, nothing, 1);
  EXPECT_GT(host.Heard.size(), 2u);
  host.ExpectHeard(0.0, 0.25);
  progress.BeginStage(0.75, 8);
  EXPECT_EQ(progress.StageEnd(), 0.75);
  progress.EndSlice(2);
  host.ExpectHeard(0.25, 0.375);
  progress.EndSlice(6);
  host.ExpectHeard(0.375, 0.75);
  progress.EndSlice(6); // more than was said
  host.ExpectHeard(0.75, 0.75);
  progress.BeginStage(1.0);
  progress.ForInOrder(count, 1, nothing, 1);
  host.ExpectHeard(0.75, 1.0);
}

TEST(Progress, StagesNest)
{
  Host host;
  Progress outer(host.Context());
  outer.BeginStage(0.5);
  {
    Progress inner(outer.Stage());
    EXPECT_EQ(&inner.Threads(), &serial);
    inner.BeginStage(0.5);
    inner.For(count, 1, nothing, 1);
    host.ExpectHeard(0.0, 0.25);
    inner.BeginStage(1.0);
    Progress innermost(inner.Stage());
    innermost.BeginStage(1.0);
    innermost.For(count, 1, nothing, 1);
    host.ExpectHeard(0.25, 0.5);
  }
  outer.BeginStage(0.75);
  Progress next(outer.Stage());
  next.BeginStage(1.0, 4);
  next.EndSlice(1);
  host.ExpectHeard(0.5, 0.5625);
  next.EndSlice(3);
  host.ExpectHeard(0.5625, 0.75);
  // The host's wish reaches the innermost, and what is outside of it.
  host.Patience = 0;
  EXPECT_THROW(next.Check(), Cancelled);
  EXPECT_THROW(outer.Check(), Cancelled);
}

// Several loops may be the work of one stage, or begin anew in it.
TEST(Progress, IsNeverTakenBack)
{
  Host host;
  Progress progress(host.Context());
  progress.BeginStage(0.5);
  progress.For(count, 1, nothing, 1);
  host.ExpectHeard(0.0, 0.5);
  progress.For(count, 1, nothing, 1);
  EXPECT_EQ(host.Heard.front(), 0.5);
  host.ExpectHeard(0.5, 0.5);
  Progress inner(progress.Stage());
  inner.BeginStage(1.0);
  inner.ForInOrder(count, 1, nothing, 1);
  host.ExpectHeard(0.5, 0.5);
}

TEST(Progress, AddReportsInIntervals)
{
  Host host;
  Progress progress(host.Context());
  constexpr std::int64_t total = 1000000;
  progress.BeginStage(1.0, total);
  for (std::int64_t i = 0; i < 1000; ++i)
  {
    progress.Add(1);
  }
  EXPECT_TRUE(host.Heard.empty());
  EXPECT_EQ(host.Asked, 0);
  for (std::int64_t i = 1000; i < total; ++i)
  {
    progress.Add(1);
  }
  EXPECT_EQ(host.Heard.size(), 15u); // 2^16 at a time
  EXPECT_EQ(host.Asked, 15);
  host.ExpectHeard(0.0, 15.0 * 0x1p16 / total);
  // What a stage has not reported is not the next one's.
  progress.BeginStage(2.0, total);
  progress.Add(0xffff);
  EXPECT_TRUE(host.Heard.empty());
  host.Patience = 0;
  EXPECT_THROW(progress.Add(1), Cancelled);
  EXPECT_EQ(host.Heard.size(), 1u);
}

// All of it once, in ranges cut at multiples of the grain, in slices that hold a range a thread.
TEST(Progress, ForRunsAll)
{
  for (const int concurrency : { 1, 4 })
  {
    const BackwardExecutor threads(concurrency);
    Host host(threads);
    Progress progress(host.Context());
    progress.BeginStage(1.0);
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
    EXPECT_EQ(host.Heard.back(), 1.0);
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
    Host host(*executor);
    Progress progress(host.Context());
    progress.BeginStage(1.0);
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
    EXPECT_LE(host.Heard.back(), 0.5) << "reported what was not done";
    EXPECT_THROW(progress.ForInOrder(count, 10, kernel, 1), std::bad_alloc);
    EXPECT_FALSE(progress.IsCancelled());
  }
}

TEST(Progress, ForThrowsCancelled)
{
  const OpenMPExecutor threads;
  for (const bool inOrder : { false, true })
  {
    Host host(threads);
    host.Patience = 2;
    Progress progress(host.Context());
    progress.BeginStage(1.0);
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
    EXPECT_EQ(host.Asked, 3);
    EXPECT_EQ(host.Heard.size(), 3u);
    EXPECT_LT(host.Heard.back(), 0.9) << "went on after it was cancelled";
    EXPECT_LT(done, 1 << 20);
    EXPECT_TRUE(progress.IsCancelled());
    // It stays so, whatever is tried then.
    EXPECT_THROW(progress.EndSlice(1), Cancelled);
    EXPECT_THROW(progress.Check(), Cancelled);
  }
}

TEST(Progress, ForInOrderRunsHereInOrder)
{
  const OpenMPExecutor threads;
  Progress progress(threads);
  progress.BeginStage(1.0);
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
  progress.BeginStage(1.0, 1 << 20);
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
  progress.BeginStage(1.0, 1 << 20);
  EXPECT_EQ(progress.NextSlice(24), 24);
}

TEST(Progress, CheckThrows)
{
  Host host;
  host.Patience = 2;
  Progress progress(host.Context());
  EXPECT_NO_THROW(progress.Check());
  EXPECT_NO_THROW(progress.Check());
  EXPECT_FALSE(progress.IsCancelled());
  EXPECT_THROW(progress.Check(), Cancelled);
  EXPECT_TRUE(progress.IsCancelled());
  EXPECT_TRUE(host.Heard.empty());
}

// Many threads look whether to stop, but the host is asked by one at a time.
TEST(Progress, ManyThreadsMayAsk)
{
  const OpenMPExecutor executor;
  Host host(executor);
  host.Patience = 1000;
  Progress progress(host.Context());
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
  EXPECT_GT(host.Asked, 1000);
  EXPECT_LE(host.Asked, 1004); // each of the others once more
  EXPECT_THROW(progress.EndSlice(1), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
