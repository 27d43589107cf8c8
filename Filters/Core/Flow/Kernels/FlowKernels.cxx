// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Kernels/FlowKernels.h"

#include <cstddef>

namespace RectifiedTransport
{

namespace
{

#define RT_FUNCTION inline
#include "Core/Flow/Kernels/Shared/AdamsWeights.h"
#undef RT_FUNCTION

} // namespace

// G_k = sin^2(pi k / 2N): dense towards both ends of [0, 1], where the velocity changes fastest.
// Steps beyond the middle are those of the other half, mirrored: sin^2 a = 1 - cos^2 a. So angles
// stay within pi/4, and G_N is 1 exactly.
double grading(std::int64_t step, std::int64_t steps)
{
  if (2 * step > steps)
  {
    return 1.0 - grading(steps - step, steps);
  }
  constexpr double halfPi = 1.57079632679489661923;
  const double angle = halfPi * static_cast<double>(step) / static_cast<double>(steps);
  const double square = angle * angle;
  // The Taylor series sin a = a (1 - a^2/(2 3) (1 - a^2/(4 5) (...))), by Horner from the term of
  // a^21, which is below the rounding.
  double sum = 1.0;
  for (int factor = 20; factor > 1; factor -= 2)
  {
    sum = 1.0 - sum * square / static_cast<double>(factor * (factor + 1));
  }
  const double sine = angle * sum;
  return sine * sine;
}

Predictor predictorFor(FlowDirection direction, double timeLeft)
{
  constexpr double wide = 0.95;
  return direction == FlowDirection::Backward && timeLeft <= wide ? Predictor::Stiff
                                                                  : Predictor::Adams;
}

StepWeights multistepWeights(std::int64_t step, std::int64_t steps, Predictor predictor)
{
  const auto at = [steps](std::int64_t k) { return grading(k, steps); };
  StepWeights weights;
  weights.Time = at(step + 1);
  weights.Length = weights.Time - at(step);
  // Start-up: step 0 knows one velocity (Euler, then the trapezoidal rule), step 1 two
  // (Adams-Bashforth 2, then the corrector of order 3). The velocities that are missing have the
  // weight 0.
  double* p = weights.Predictor;
  double* c = weights.Corrector;
  if (step == 0)
  {
    p[0] = 1.0;
    p[1] = p[2] = 0.0;
    c[0] = c[1] = 0.5;
    c[2] = 0.0;
    return weights;
  }
  // The times of the two velocities before, over the step's length (alpha and beta of
  // adamsWeights).
  const double first = (at(step - 1) - at(step)) / weights.Length;
  const double second = step > 1 ? (at(step - 2) - at(step)) / weights.Length : 2.0 * first;
  adamsWeights(first, second, weights.Predictor, weights.Corrector);
  if (step == 1)
  {
    // The integral over the step of the line through the two velocities.
    p[0] = 1.0 - 0.5 / first;
    p[1] = 0.5 / first;
    p[2] = 0.0;
  }
  else if (predictor == Predictor::Stiff)
  {
    p[0] = 1.0 - 0.5 / second;
    p[1] = 0.0;
    p[2] = 0.5 / second;
  }
  return weights;
}

// Backwards time 1 comes first, so that the graded time is what is left until time 1.
std::vector<StepWeights> multistepWeightsOf(std::int64_t steps, FlowDirection direction)
{
  std::vector<StepWeights> weights;
  weights.reserve(static_cast<std::size_t>(steps));
  for (std::int64_t step = 0; step < steps; ++step)
  {
    weights.push_back(
      multistepWeights(step, steps, predictorFor(direction, grading(step + 1, steps))));
  }
  return weights;
}

// Adams weights depend on ratios of steps alone: only times and lengths are stretched.
StepWeights stretchedWeights(
  std::int64_t step, std::int64_t count, std::int64_t steps, Predictor predictor)
{
  const double end = grading(count, steps);
  StepWeights weights = multistepWeights(step, steps, predictor);
  weights.Time = step + 1 == count ? 1.0 : weights.Time / end;
  weights.Length /= end;
  return weights;
}

template <int Dimension>
FlowKernels<Dimension> flowKernels(InstructionSet set)
{
  return chooseKernels(set, [](auto chosen) { return flowKernelsOf<Dimension, chosen>(); });
}

template FlowKernels<1> flowKernels<1>(InstructionSet);
template FlowKernels<2> flowKernels<2>(InstructionSet);
template FlowKernels<3> flowKernels<3>(InstructionSet);

} // namespace RectifiedTransport
