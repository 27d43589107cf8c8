// SPDX-License-Identifier: BSD-3-Clause
// What a computation reports and queries while it runs.
#ifndef RecordingContext_h
#define RecordingContext_h

#include "Core/Parallel/Context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace RectifiedTransport
{

// A context that records the progress that is reported, and cancels after a number of queries.
class RecordingContext
{
public:
  explicit RecordingContext(const Executor& threads)
    : Threads(threads)
  {
  }

  RectifiedTransport::Context Context()
  {
    return { this->Threads,
      [this](double fraction) {
        EXPECT_EQ(std::this_thread::get_id(), this->Thread) << "reported on another thread";
        this->Reported.push_back(fraction);
      },
      [this]() {
        EXPECT_FALSE(this->IsQueried.exchange(true)) << "queried by two at a time";
        const bool stop = ++this->Queries > this->MaximumQueries;
        this->IsQueried = false;
        return stop;
      } };
  }

  // What was reported since the last call ascends from `low` to `high`.
  void ExpectReported(double low, double high)
  {
    ASSERT_FALSE(this->Reported.empty());
    EXPECT_TRUE(std::is_sorted(this->Reported.begin(), this->Reported.end()));
    EXPECT_GE(this->Reported.front(), low);
    EXPECT_NEAR(this->Reported.back(), high, 1e-15);
    this->Reported.clear();
  }

  std::vector<double> Reported;
  std::atomic<int> Queries{ 0 };
  int MaximumQueries = 1 << 30;

private:
  const Executor& Threads;
  const std::thread::id Thread = std::this_thread::get_id();
  std::atomic<bool> IsQueried{ false };
};

} // namespace RectifiedTransport

#endif
