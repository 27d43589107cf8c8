// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Kernels/FlowKernels.h"

namespace RectifiedTransport
{

namespace
{

// sin^2(pi/2 * step / steps) from basic operations alone: the library's sine may differ in the
// last bit from one processor to the next.
double grading(std::int64_t step, std::int64_t steps)
{
  if (2 * step > steps)
  {
    return 1.0 - grading(steps - step, steps);
  }
  constexpr double halfPi = 1.57079632679489661923;
  const double angle = halfPi * static_cast<double>(step) / static_cast<double>(steps);
  const double square = angle * angle;
  double sum = 1.0;
  for (int factor = 20; factor > 1; factor -= 2)
  {
    sum = 1.0 - sum * square / static_cast<double>(factor * (factor + 1));
  }
  const double sine = angle * sum;
  return sine * sine;
}

} // namespace

StepWeights multistepWeights(std::int64_t step, std::int64_t steps)
{
  const auto at = [steps](std::int64_t k) { return grading(k, steps); };
  StepWeights weights;
  weights.Time = at(step + 1);
  weights.Length = weights.Time - at(step);
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
  const double alpha = (at(step - 1) - at(step)) / weights.Length;
  c[0] = (1.0 / 3.0 - alpha / 2.0) / (1.0 - alpha);
  c[1] = (1.0 / 3.0 - (1.0 + alpha) / 2.0 + alpha) / alpha;
  c[2] = -1.0 / (6.0 * alpha * (alpha - 1.0));
  if (step == 1)
  {
    p[0] = 1.0 - 0.5 / alpha;
    p[1] = 0.5 / alpha;
    p[2] = 0.0;
    return weights;
  }
  const double beta = (at(step - 2) - at(step)) / weights.Length;
  p[0] = (1.0 / 3.0 - (alpha + beta) / 2.0 + alpha * beta) / (alpha * beta);
  p[1] = (1.0 / 3.0 - beta / 2.0) / (alpha * (alpha - beta));
  p[2] = (1.0 / 3.0 - alpha / 2.0) / (beta * (beta - alpha));
  return weights;
}

const FlowKernels& flowKernels([[maybe_unused]] InstructionSet set)
{
#ifdef RECTIFIEDTRANSPORT_X86
  if (set == InstructionSet::AVX512)
  {
    return flowKernelsAVX512();
  }
  if (set == InstructionSet::AVX2)
  {
    return flowKernelsAVX2();
  }
#endif
  return flowKernelsSSE2();
}

} // namespace RectifiedTransport
