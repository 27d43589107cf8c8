// SPDX-License-Identifier: BSD-3-Clause
// What the host hears of long work, and how it stops it.
#include "Core/Seeds/Seeds.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace RectifiedTransport
{
namespace
{

// Collects progress, and cancels once it passes `limit`.
struct Listener
{
  std::vector<double> Heard;
  std::atomic<double> Last{ 0.0 };
  double Limit = 2.0;
  std::thread::id Thread = std::this_thread::get_id();
  bool OtherThread = false;

  RectifiedTransport::Monitor Monitor()
  {
    return { [this](double progress) {
              this->OtherThread = this->OtherThread || std::this_thread::get_id() != this->Thread;
              this->Heard.push_back(progress);
              this->Last = progress;
            },
      [this]() { return this->Last >= this->Limit; } };
  }

  void ExpectMonotone(const std::string& what) const
  {
    ASSERT_FALSE(this->Heard.empty()) << what;
    EXPECT_TRUE(std::is_sorted(this->Heard.begin(), this->Heard.end())) << what;
    EXPECT_GE(this->Heard.front(), 0.0) << what;
    EXPECT_LE(this->Heard.back(), 1.0) << what;
    EXPECT_GT(this->Heard.back(), 0.9) << what;
    EXPECT_FALSE(this->OtherThread) << what << ": called on another thread";
  }
};

const TestDensity<3>& volume()
{
  static const TestDensity<3> density = twoGaussians<3>({ 96, 96, 96 });
  return density;
}

constexpr std::size_t ParticleCount = 60000;

TEST(Monitor, ProgressOfTheTables)
{
  Listener listener;
  const RectifiedFlow<3> flow(volume().Source(), OpenMPExecutor(), listener.Monitor());
  EXPECT_TRUE(static_cast<bool>(flow));
  listener.ExpectMonotone("tables");
}

TEST(Monitor, ProgressOfTheFlow)
{
  const RectifiedFlow<3> flow = makeFlow(volume());
  const Points<3> seeds = randomPoints<3>(flow.Size(), ParticleCount);
  Points<3> positions(seeds.size());
  const double* from = seeds.data()->data();
  double* to = positions.data()->data();
  for (const Integrator method : AllIntegrators)
  {
    Listener forth;
    EXPECT_FALSE(
      flow.Forward(from, ParticleCount, to, steps(16, method), OpenMPExecutor(), forth.Monitor())
        .Cancelled);
    forth.ExpectMonotone("forward, " + nameOf(method));
    Listener back;
    EXPECT_FALSE(
      flow.Backward(from, ParticleCount, to, steps(16, method), OpenMPExecutor(), back.Monitor())
        .Cancelled);
    back.ExpectMonotone("backward, " + nameOf(method));
  }
  Points<3> path(3 * seeds.size());
  Listener at;
  EXPECT_FALSE(flow
                 .ForwardAt(from, ParticleCount, { 0.1, 0.5, 1.0 }, path.data()->data(), steps(16),
                   OpenMPExecutor(), at.Monitor())
                 .Cancelled);
  at.ExpectMonotone("at times");
}

TEST(Monitor, DoesNotChangeTheResult)
{
  Listener listener;
  const RectifiedFlow<3> watched(volume().Source(), OpenMPExecutor(), listener.Monitor());
  const RectifiedFlow<3> flow = makeFlow(volume());
  const Points<3> seeds = randomPoints<3>(flow.Size(), 5000);
  Points<3> positions(seeds.size());
  Listener other;
  watched.Forward(seeds.data()->data(), 5000, positions.data()->data(), FlowOptions(),
    OpenMPExecutor(), other.Monitor());
  EXPECT_TRUE(sameBits<3>(positions, runForward(flow, seeds)));
}

TEST(Monitor, CancelTheTables)
{
  Listener listener;
  listener.Limit = 0.0;
  const RectifiedFlow<3> flow(volume().Source(), OpenMPExecutor(), listener.Monitor());
  EXPECT_FALSE(static_cast<bool>(flow));
}

TEST(Monitor, CancelTheFlow)
{
  const RectifiedFlow<3> flow = makeFlow(volume());
  const Points<3> seeds = randomPoints<3>(flow.Size(), ParticleCount);
  Points<3> positions(3 * seeds.size());
  const double* from = seeds.data()->data();
  double* to = positions.data()->data();
  for (const double limit : { 0.0, 0.3 })
  {
    for (const Integrator method : AllIntegrators)
    {
      Listener forth;
      forth.Limit = limit;
      EXPECT_TRUE(
        flow.Forward(from, ParticleCount, to, steps(16, method), OpenMPExecutor(), forth.Monitor())
          .Cancelled)
        << nameOf(method);
      EXPECT_LT(forth.Last, limit == 0.0 ? 0.9 : 1.1) << "went on after it was cancelled";
      Listener back;
      back.Limit = limit;
      EXPECT_TRUE(
        flow.Backward(from, ParticleCount, to, steps(16, method), OpenMPExecutor(), back.Monitor())
          .Cancelled)
        << nameOf(method);
      EXPECT_LT(back.Last, limit == 0.0 ? 0.9 : 1.1) << "went on after it was cancelled";
    }
    Listener at;
    at.Limit = limit;
    EXPECT_TRUE(flow
                  .ForwardAt(from, ParticleCount, { 0.1, 0.5, 1.0 }, to, FlowOptions(),
                    OpenMPExecutor(), at.Monitor())
                  .Cancelled);
  }
}

TEST(Monitor, ProgressAndCancelOfTheSeeds)
{
  constexpr std::int64_t count = 300000;
  std::vector<double> points(3 * count);
  const Point<3> lengths = { 1.0, 2.0, 3.0 };
  for (const SeedPattern pattern : { SeedPattern::BlueNoise, SeedPattern::Jittered,
         SeedPattern::LowDiscrepancy, SeedPattern::Random })
  {
    for (const double limit : { 0.0, 2.0 })
    {
      Listener listener;
      listener.Limit = limit;
      const bool complete =
        generateSeeds<3>(pattern, lengths, count, 1, points.data(), listener.Monitor());
      EXPECT_EQ(complete, limit > 1.0) << static_cast<int>(pattern);
      EXPECT_EQ(listener.Heard.size() > 1, complete) << static_cast<int>(pattern);
      EXPECT_TRUE(std::is_sorted(listener.Heard.begin(), listener.Heard.end()));
    }
  }
  Listener listener;
  listener.Limit = 0.0;
  EXPECT_FALSE(generateLattice<3>({ 50, 60, 70 }, points.data(), listener.Monitor()));
  EXPECT_FALSE(generateJitteredLattice<3>({ 50, 60, 70 }, 1, points.data(), listener.Monitor()));
  EXPECT_EQ(listener.Heard.size(), 2u);
}

// However many steps a block of particles takes, the host is asked in between.
TEST(Monitor, CancelManySteps)
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
      int asked = 0;
      const Monitor monitor = { {}, [&asked]() { return ++asked > 3; } };
      const double* from = seeds.data()->data();
      double* to = positions.data()->data();
      const FlowReport report = backward
        ? flow.Backward(from, 64, to, options, SerialExecutor(), monitor)
        : flow.Forward(from, 64, to, options, SerialExecutor(), monitor);
      EXPECT_TRUE(report.Cancelled) << nameOf(method);
      EXPECT_LE(report.Evaluations, 64 * 4 * 256) << nameOf(method);
      EXPECT_GT(report.Evaluations, 0) << nameOf(method);
    }
  }
}

} // namespace
} // namespace RectifiedTransport
