// SPDX-License-Identifier: BSD-3-Clause
// The weights of the graded Adams-Bashforth-Moulton method, by their definition.
#include "Core/Flow/Kernels/FlowKernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// sin^2(pi/2 k/n) from 0 to 1: steps grow short toward both ends.
double gradedTime(std::int64_t step, std::int64_t steps)
{
  const double sine =
    std::sin(0.5 * std::acos(-1.0) * static_cast<double>(step) / static_cast<double>(steps));
  return sine * sine;
}

// Weights of values at `places`, in units of the step and from its start, give the mean over the
// step of every polynomial of a degree below their number.
void expectExact(const double* weights, const std::vector<double>& places, const char* what)
{
  for (std::size_t degree = 0; degree < places.size(); ++degree)
  {
    double mean = 0.0;
    double size = 1.0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const double term = weights[i] * std::pow(places[i], static_cast<double>(degree));
      mean += term;
      size += std::abs(term);
    }
    EXPECT_NEAR(mean, 1.0 / (static_cast<double>(degree) + 1.0), 1e-12 * size)
      << what << ", degree " << degree;
  }
  for (std::size_t i = places.size(); i < 3; ++i)
  {
    EXPECT_EQ(weights[i], 0.0) << what;
  }
}

TEST(MultistepWeights, IntegratePolynomials)
{
  for (const std::int64_t steps : { 1, 2, 3, 5, 32, 1000, 320000 })
  {
    const std::int64_t stride = std::max<std::int64_t>(1, steps / 97);
    for (std::int64_t step = 0; step < steps; step += step < 4 ? 1 : stride)
    {
      SCOPED_TRACE(testing::Message() << step << " of " << steps);
      const StepWeights weights = multistepWeights(step, steps);
      const double start = gradedTime(step, steps);
      EXPECT_NEAR(weights.Time, gradedTime(step + 1, steps), 1e-14);
      EXPECT_NEAR(weights.Length, weights.Time - start, 1e-14);
      // Where the velocities of the last steps are; at first there are none.
      std::vector<double> behind{ 0.0 };
      const double length = multistepWeights(step, steps).Length;
      double distance = 0.0;
      for (std::int64_t k = step - 1; k >= 0 && behind.size() < 3; --k)
      {
        distance -= multistepWeights(k, steps).Length;
        behind.push_back(distance / length);
      }
      expectExact(weights.Predictor, behind, "predictor");
      std::vector<double> ahead{ 1.0 };
      for (std::size_t i = 0; i < std::min<std::size_t>(2, behind.size()); ++i)
      {
        ahead.push_back(behind[i]);
      }
      expectExact(weights.Corrector, ahead, "corrector");
    }
  }
}

// The predictor of stiff flows: the mean over the step of the line through the newest velocity and
// the one two steps before. The rest of a step is as usual.
TEST(MultistepWeights, StiffPredictor)
{
  for (const std::int64_t steps : { 3, 32, 1000 })
  {
    for (std::int64_t step = 0; step < steps; step += 1 + step / 8)
    {
      SCOPED_TRACE(testing::Message() << step << " of " << steps);
      const StepWeights usual = multistepWeights(step, steps);
      const StepWeights stiff = multistepWeights(step, steps, Predictor::Stiff);
      EXPECT_EQ(stiff.Time, usual.Time);
      EXPECT_EQ(stiff.Length, usual.Length);
      EXPECT_TRUE(std::equal(stiff.Corrector, stiff.Corrector + 3, usual.Corrector));
      if (step < 2)
      {
        EXPECT_TRUE(std::equal(stiff.Predictor, stiff.Predictor + 3, usual.Predictor));
        continue;
      }
      const double behind =
        multistepWeights(step - 1, steps).Length + multistepWeights(step - 2, steps).Length;
      EXPECT_EQ(stiff.Predictor[1], 0.0);
      const double line[] = { stiff.Predictor[0], stiff.Predictor[2] };
      double mean = 0.0;
      double slope = 0.0;
      for (const int k : { 0, 1 })
      {
        mean += line[k];
        slope += line[k] * (k == 0 ? 0.0 : -behind / stiff.Length);
      }
      EXPECT_NEAR(mean, 1.0, 1e-12);
      EXPECT_NEAR(slope, 0.5, 1e-12);
    }
  }
}

// Backwards, but for the start and the end of the way.
TEST(MultistepWeights, Directions)
{
  const std::vector<StepWeights> forward = multistepWeightsOf(64, FlowDirection::Forward);
  const std::vector<StepWeights> backward = multistepWeightsOf(64, FlowDirection::Backward);
  ASSERT_EQ(forward.size(), 64U);
  ASSERT_EQ(backward.size(), 64U);
  for (std::size_t step = 0; step < forward.size(); ++step)
  {
    const bool isStiff = step > 1 && forward[step].Time <= 0.95;
    EXPECT_EQ(backward[step].Predictor[1] == 0.0, isStiff || step == 0) << step;
    EXPECT_EQ(forward[step].Predictor[1] == 0.0, step == 0) << step;
  }
}

// The predict-evaluate-correct pair of even steps on v = -rate x: third order, and stable for a
// rate of 1.2 a step where Adams is not beyond .29.
double decayed(Predictor predictor, double rate, int count)
{
  const std::int64_t many = 1 << 20; // of which steps in the middle are even
  const StepWeights weights = multistepWeights(many / 2, many, predictor);
  double x = std::exp(-2.0 * rate);
  double v[3] = { -rate * x, -rate * std::exp(-rate), -rate };
  for (int step = 0; step < count; ++step)
  {
    const double* p = weights.Predictor;
    const double* c = weights.Corrector;
    const double newest = -rate * (x + p[0] * v[0] + p[1] * v[1] + p[2] * v[2]);
    x += c[0] * newest + c[1] * v[0] + c[2] * v[1];
    v[2] = v[1];
    v[1] = v[0];
    v[0] = newest;
  }
  return x;
}

TEST(MultistepWeights, Stability)
{
  const auto isStable = [](Predictor predictor, double rate) {
    return std::abs(decayed(predictor, rate, 4000)) < 1.0;
  };
  EXPECT_TRUE(isStable(Predictor::Adams, 0.28));
  EXPECT_FALSE(isStable(Predictor::Adams, 0.3));
  EXPECT_TRUE(isStable(Predictor::Stiff, 1.19));
  EXPECT_FALSE(isStable(Predictor::Stiff, 1.21));
  for (const Predictor predictor : { Predictor::Adams, Predictor::Stiff })
  {
    const auto error = [&](int count) {
      return std::abs(decayed(predictor, 1.0 / count, count) - std::exp(-1.0 - 2.0 / count));
    };
    EXPECT_NEAR(std::log2(error(64) / error(128)), 3.0, 0.1);
  }
}

} // namespace
} // namespace RectifiedTransport
