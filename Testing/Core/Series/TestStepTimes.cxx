// SPDX-License-Identifier: BSD-3-Clause
// Between which steps of a series a time is.
#include "Core/Series/StepTimes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace RectifiedTransport
{
namespace
{

StepTimes timesOf(const std::vector<double>& times)
{
  return { times.data(), times.size() };
}

TEST(StepTimes, AreFiniteSortedAndOnce)
{
  const double infinite = std::numeric_limits<double>::infinity();
  const StepTimes times = timesOf({ 3.0, 1.0, std::nan(""), 1.0, infinite, 2.0, -infinite });
  EXPECT_TRUE(times == timesOf({ 1.0, 2.0, 3.0 }));
  EXPECT_EQ(times.Count(), 3);
  EXPECT_EQ(StepTimes(nullptr, 0).Count(), 0);
  EXPECT_EQ(StepTimes(infinite)[0], infinite);
}

TEST(StepTimes, FindTheInterval)
{
  const StepTimes times = timesOf({ 0.0, 1.0, 3.0 });
  const auto check = [&](double time, int first, double part) {
    const TimeInterval place = times.Find(time);
    EXPECT_EQ(place.First, first) << time;
    EXPECT_EQ(place.Second, first + 1) << time;
    EXPECT_EQ(place.Part, part) << time;
  };
  check(-1.0, 0, 0.0);
  check(0.25, 0, 0.25);
  check(1.0, 1, 0.0);
  check(2.5, 1, 0.75);
  check(3.0, 1, 1.0);
  check(9.0, 1, 1.0);
  EXPECT_EQ(times.Clamp(9.0), 3.0);
  EXPECT_EQ(StepTimes(5.0).Find(7.0).Second, 0);
}

TEST(StepTimes, PassTheLargestDouble)
{
  const double largest = std::numeric_limits<double>::max();
  const StepTimes times = timesOf({ -largest, largest });
  EXPECT_EQ(times.Find(0.0).Part, 0.5);
  EXPECT_EQ(times.Resampled(2), (std::vector<double>{ -largest, 0.0, largest }));
}

TEST(StepTimes, AreResampled)
{
  EXPECT_EQ(
    timesOf({ 0.0, 1.0, 3.0 }).Resampled(2), (std::vector<double>{ 0.0, 0.5, 1.0, 2.0, 3.0 }));
  EXPECT_EQ(StepTimes(5.0).Resampled(3), (std::vector<double>{ 5.0 }));
}

} // namespace
} // namespace RectifiedTransport
