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

} // namespace
} // namespace RectifiedTransport
