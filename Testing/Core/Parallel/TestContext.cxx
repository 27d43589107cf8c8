// SPDX-License-Identifier: BSD-3-Clause
// The progress that long work reports, and its cancellation.
#include "../../SeedPatterns.h"
#include "Core/Seeds/Seeds.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <thread>

namespace RectifiedTransport
{
namespace
{

// Records progress, and cancels once it passes `Limit`.
struct Listener
{
  std::vector<double> Reported;
  std::atomic<double> Last{ 0.0 };
  double Limit = 2.0;
  std::thread::id Thread = std::this_thread::get_id();
  bool OtherThread = false;

  RectifiedTransport::Context Context()
  {
    static const OpenMPExecutor threads;
    return { threads,
      [this](double progress) {
        this->OtherThread = this->OtherThread || std::this_thread::get_id() != this->Thread;
        this->Reported.push_back(progress);
        this->Last = progress;
      },
      [this]() { return this->Last >= this->Limit; } };
  }

  void ExpectMonotone(const std::string& what) const
  {
    ASSERT_FALSE(this->Reported.empty()) << what;
    EXPECT_TRUE(std::is_sorted(this->Reported.begin(), this->Reported.end())) << what;
    EXPECT_GE(this->Reported.front(), 0.0) << what;
    EXPECT_LE(this->Reported.back(), 1.0) << what;
    EXPECT_GT(this->Reported.back(), 0.9) << what;
    EXPECT_FALSE(this->OtherThread) << what << ": called on another thread";
  }
};

const TestDensity<3>& volume()
{
  static const TestDensity<3> density = twoGaussians<3>({ 96, 96, 96 });
  return density;
}

constexpr std::size_t ParticleCount = 60000;

TEST(Context, ProgressOfTheTables)
{
  Listener listener;
  const RectifiedFlow<3> flow(volume().Source(), listener.Context());
  listener.ExpectMonotone("tables");
}

TEST(Context, ProgressOfTheFlow)
{
  const RectifiedFlow<3> flow = makeFlow(volume());
  const Points<3> seeds = randomPoints<3>(flow.Size(), ParticleCount);
  Points<3> positions(seeds.size());
  for (const Integrator method : AllIntegrators)
  {
    Listener forth;
    flow.Forward(seeds, positions, steps(16, method), forth.Context());
    forth.ExpectMonotone("forward, " + nameOf(method));
    Listener back;
    flow.Backward(seeds, positions, steps(16, method), back.Context());
    back.ExpectMonotone("backward, " + nameOf(method));
  }
  Points<3> path(3 * seeds.size());
  Listener at;
  flow.ForwardAt(seeds, { 0.1, 0.5, 1.0 }, path, steps(16), at.Context());
  at.ExpectMonotone("at times");
}

TEST(Context, DoesNotChangeTheResult)
{
  Listener listener;
  const RectifiedFlow<3> watched(volume().Source(), listener.Context());
  const RectifiedFlow<3> flow = makeFlow(volume());
  const Points<3> seeds = randomPoints<3>(flow.Size(), 5000);
  Points<3> positions(seeds.size());
  Listener other;
  watched.Forward(seeds, positions, FlowOptions(), other.Context());
  EXPECT_TRUE(sameBits<3>(positions, runForward(flow, seeds)));
}

TEST(Context, CancelTheTables)
{
  Listener listener;
  listener.Limit = 0.0;
  EXPECT_THROW(RectifiedFlow<3>(volume().Source(), listener.Context()), Cancelled);
  EXPECT_LT(listener.Last, 0.9) << "went on after it was cancelled";
}

TEST(Context, CancelTheFlow)
{
  const RectifiedFlow<3> flow = makeFlow(volume());
  const Points<3> seeds = randomPoints<3>(flow.Size(), ParticleCount);
  Points<3> positions(seeds.size());
  Points<3> path(3 * seeds.size());
  for (const double limit : { 0.0, 0.3 })
  {
    for (const Integrator method : AllIntegrators)
    {
      Listener forth;
      forth.Limit = limit;
      EXPECT_THROW(flow.Forward(seeds, positions, steps(16, method), forth.Context()), Cancelled)
        << nameOf(method);
      EXPECT_LT(forth.Last, limit == 0.0 ? 0.9 : 1.1) << "went on after it was cancelled";
      Listener back;
      back.Limit = limit;
      EXPECT_THROW(flow.Backward(seeds, positions, steps(16, method), back.Context()), Cancelled)
        << nameOf(method);
      EXPECT_LT(back.Last, limit == 0.0 ? 0.9 : 1.1) << "went on after it was cancelled";
    }
    Listener at;
    at.Limit = limit;
    EXPECT_THROW(
      flow.ForwardAt(seeds, { 0.1, 0.5, 1.0 }, path, FlowOptions(), at.Context()), Cancelled);
  }
}

// The one-off is the tables and the flow, with the context in both.
TEST(Context, ProgressAndCancelOfTheOneOff)
{
  const Points<3> seeds = randomPoints<3>(volume().Size, 5000);
  Listener listener;
  const Points<3> positions =
    transportPoints<3>(volume().Source(), seeds, steps(16), listener.Context());
  listener.ExpectMonotone("one-off");
  EXPECT_TRUE(sameBits<3>(positions, runForward(makeFlow(volume()), seeds, steps(16))));
  Listener tables;
  tables.Limit = 0.0;
  EXPECT_THROW(
    transportPoints<3>(volume().Source(), seeds, steps(16), tables.Context()), Cancelled);
  EXPECT_LE(tables.Last, 0.1) << "went on after it was cancelled";
  Listener flow;
  flow.Limit = 0.5;
  EXPECT_THROW(transportPoints<3>(volume().Source(), seeds, steps(16), flow.Context()), Cancelled);
}

TEST(Context, ProgressAndCancelOfTheSeeds)
{
  constexpr std::int64_t count = 300000;
  Points<3> points(count);
  const Point<3> lengths = { 1.0, 2.0, 3.0 };
  for (const SeedPattern pattern : scatteredPatterns)
  {
    for (const double limit : { 0.0, 2.0 })
    {
      Listener listener;
      listener.Limit = limit;
      const bool complete = limit > 1.0;
      const auto generate = [&]() {
        generateSeeds<3>(pattern, lengths, 1, points, listener.Context());
      };
      if (complete)
      {
        EXPECT_NO_THROW(generate()) << static_cast<int>(pattern);
      }
      else
      {
        EXPECT_THROW(generate(), Cancelled) << static_cast<int>(pattern);
      }
      EXPECT_EQ(listener.Reported.size() > 1, complete) << static_cast<int>(pattern);
      EXPECT_TRUE(std::is_sorted(listener.Reported.begin(), listener.Reported.end()));
    }
  }
  Listener listener;
  listener.Limit = 0.0;
  points.resize(50 * 60 * 70);
  EXPECT_THROW(generateLattice<3>({ 50, 60, 70 }, points, listener.Context()), Cancelled);
  EXPECT_THROW(
    generateJitteredLattice<3>({ 50, 60, 70 }, 1, points, listener.Context()), Cancelled);
  EXPECT_EQ(listener.Reported.size(), 2u);
}

// However many steps a block of particles takes, IsCancelled is called in between. Work that goes
// on after it returned true calls it again: it must not be much.
TEST(Context, CancelManySteps)
{
  const RectifiedFlow<3> flow = makeFlow(volume());
  const Points<3> seeds = randomPoints<3>(flow.Size(), 64);
  Points<3> positions(seeds.size());
  for (const Integrator method : AllIntegrators)
  {
    for (const bool backward : { false, true })
    {
      FlowOptions options = steps(10000, method);
      options.Tolerance = 1e-14;
      int queries = 0;
      int limit = std::numeric_limits<int>::max();
      const SerialExecutor serial;
      const RectifiedTransport::Context context(serial, {}, [&]() { return ++queries > limit; });
      const auto run = [&]() {
        return backward ? flow.Backward(seeds, positions, options, context)
                        : flow.Forward(seeds, positions, options, context);
      };
      const FlowReport report = run();
      EXPECT_LE(report.Evaluations, 64 * 256 * std::int64_t{ queries }) << nameOf(method);
      EXPECT_GT(report.Evaluations, 64 * 4 * 256) << nameOf(method);
      queries = 0;
      limit = 3;
      EXPECT_THROW(run(), Cancelled) << nameOf(method);
      EXPECT_LE(queries, limit + 2) << nameOf(method); // the last at the end of the slice
    }
  }
}

} // namespace
} // namespace RectifiedTransport
