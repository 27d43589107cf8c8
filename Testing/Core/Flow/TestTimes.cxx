// SPDX-License-Identifier: BSD-3-Clause
// Positions at intermediate times, all of one run.
#include "TestDimensions.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace RectifiedTransport
{
namespace
{

const std::vector<double> Moments = { 0.0, 1e-4, 0.03, 0.2, 0.5, 0.77, 0.95, 0.999, 1.0 };

// The positions at each time.
template <int Dimension>
std::vector<Points<Dimension>> forwardAt(const RectifiedFlow<Dimension>& flow,
  const NotDeduced<Points<Dimension>>& seeds, const std::vector<double>& times,
  const FlowOptions& options)
{
  Points<Dimension> all(seeds.size() * times.size());
  flow.ForwardAt(seeds, times, all, options);
  std::vector<Points<Dimension>> positions(times.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    positions[i % times.size()].push_back(all[i]);
  }
  return positions;
}

template <class T>
using Times = DimensionTest<T>;
TYPED_TEST_SUITE(Times, Dimensions);

template <int Dimension>
TestDensity<Dimension> density()
{
  return twoGaussians<Dimension>(sizeFor<Dimension>({ 200 }, { 110, 80 }, { 24, 33, 28 }));
}

// Calls check(flow, seeds, options) with every integrator.
template <int Dimension, class Check>
void forAllIntegrators(
  const TestDensity<Dimension>& target, std::size_t count, int stepCount, const Check& check)
{
  const RectifiedFlow<Dimension> flow = makeFlow(target);
  const Points<Dimension> seeds = randomPoints<Dimension>(flow.Size(), count);
  for (const Integrator method : AllIntegrators)
  {
    SCOPED_TRACE(nameOf(method));
    check(flow, seeds, steps(stepCount, method));
  }
}

// The seeds at 0, Forward's result at 1, to the last bit.
TYPED_TEST(Times, Ends)
{
  constexpr int Dimension = TypeParam::value;
  forAllIntegrators(density<Dimension>(), 700, 24,
    [](const auto& flow, const auto& seeds, const FlowOptions& options) {
      const auto positions = forwardAt(flow, seeds, Moments, options);
      EXPECT_TRUE(sameBits<Dimension>(positions.front(), seeds));
      EXPECT_TRUE(sameBits<Dimension>(positions.back(), runForward(flow, seeds, options)));
    });
}

TYPED_TEST(Times, Oracle)
{
  constexpr int Dimension = TypeParam::value;
  const TestDensity<Dimension> target = density<Dimension>();
  const RectifiedFlow<Dimension> flow = makeFlow(target);
  const Oracle<Dimension> oracle(target.Values, target.Size);
  const Points<Dimension> seeds = randomPoints<Dimension>(target.Size, 60);
  std::vector<Points<Dimension>> truth;
  for (const double time : Moments)
  {
    truth.push_back(oracle.Forward(seeds, time));
  }
  for (const Integrator method : AllIntegrators)
  {
    FlowOptions options = steps(method == Integrator::Euler ? 2000 : 64, method);
    options.Tolerance = 0.01;
    const auto positions = forwardAt(flow, seeds, Moments, options);
    for (std::size_t i = 0; i < Moments.size(); ++i)
    {
      EXPECT_LT(comparePositions<Dimension>(positions[i], truth[i]).Mean, 0.05)
        << nameOf(method) << " at " << Moments[i];
    }
  }
}

// Which other times are asked for does not matter, nor does asking twice.
TYPED_TEST(Times, AnyChoice)
{
  constexpr int Dimension = TypeParam::value;
  forAllIntegrators(density<Dimension>(), 300, 24,
    [](const auto& flow, const auto& seeds, const FlowOptions& options) {
      const auto all = forwardAt(flow, seeds, Moments, options);
      const auto some = forwardAt(flow, seeds, { 0.5, 0.5, 0.95 }, options);
      EXPECT_TRUE(sameBits<Dimension>(some[0], all[4]));
      EXPECT_TRUE(sameBits<Dimension>(some[1], all[4]));
      EXPECT_TRUE(sameBits<Dimension>(some[2], all[6]));
    });
}

// Whether a particle is redone, because it meets an empty box or ends in an empty cell, does not
// depend on the times that are asked for.
TYPED_TEST(Times, AnyChoiceWithHoles)
{
  constexpr int Dimension = TypeParam::value;
  forAllIntegrators(discWithHole<Dimension>(density<Dimension>().Size), 700, 8,
    [](const auto& flow, const auto& seeds, const FlowOptions& options) {
      const auto all = forwardAt(flow, seeds, Moments, options);
      EXPECT_TRUE(sameBits<Dimension>(all.front(), seeds));
      EXPECT_TRUE(sameBits<Dimension>(all.back(), runForward(flow, seeds, options)));
      for (const std::size_t i : { 2, 4, 7 })
      {
        const auto one = forwardAt(flow, seeds, { Moments[i] }, options);
        EXPECT_TRUE(sameBits<Dimension>(one[0], all[i])) << "at " << Moments[i];
      }
    });
}

// Neither the executor nor the other particles matter, as in Forward.
TEST(TimesWithHoles, ExecutorsAndSubsets)
{
  const TestDensity<2> target = discWithHole<2>({ 150, 97 });
  const RectifiedFlow<2> flow = makeFlow(target);
  const Points<2> seeds = randomPoints<2>(target.Size, 3000);
  const std::size_t half = seeds.size() / 2;
  const std::vector<double> times = { 0.4, 1.0 };
  for (const Integrator method : AllIntegrators)
  {
    const FlowOptions options = steps(12, method);
    const auto all = forwardAt(flow, seeds, times, options);
    Points<2> reversed(seeds.rbegin(), seeds.rbegin() + static_cast<std::ptrdiff_t>(half));
    Points<2> positions(times.size() * half);
    flow.ForwardAt(reversed, times, positions, options, SerialExecutor());
    std::int64_t different = 0;
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      const std::size_t particle = seeds.size() - 1 - i / times.size();
      different += positions[i] != all[i % times.size()][particle];
    }
    EXPECT_EQ(different, 0) << nameOf(method);
  }
}

// Until the box is smaller than the domain, particles go straight to the centroid.
TEST(TimesStraight, ToTheCentroid)
{
  const TestDensity<2> target = twoGaussians<2>({ 64, 64 });
  const RectifiedFlow<2> flow = makeFlow(target);
  const Points<2> seeds = { { 30.0, 33.0 } };
  const Point<2> centroid = flow.Centroid();
  const auto positions = forwardAt(flow, seeds, { 0.1, 0.25 }, FlowOptions());
  for (int axis = 0; axis < 2; ++axis)
  {
    const double way = centroid[axis] - seeds[0][axis];
    EXPECT_NEAR(positions[0][0][axis], seeds[0][axis] + 0.1 * way, 1e-9);
    EXPECT_NEAR(positions[1][0][axis], seeds[0][axis] + 0.25 * way, 1e-9);
  }
}

} // namespace
} // namespace RectifiedTransport
