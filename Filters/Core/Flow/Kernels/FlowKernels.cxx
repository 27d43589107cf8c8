// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Kernels/FlowKernels.h"

namespace RectifiedTransport
{

namespace
{

#include "Core/Flow/Kernels/AdamsWeights.txx"

} // namespace

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
  const double first = (at(step - 1) - at(step)) / weights.Length;
  const double second = step > 1 ? (at(step - 2) - at(step)) / weights.Length : 2.0 * first;
  adamsWeights(first, second, weights.Predictor, weights.Corrector);
  if (step == 1)
  {
    p[0] = 1.0 - 0.5 / first;
    p[1] = 0.5 / first;
    p[2] = 0.0;
  }
  return weights;
}

StepWeights stretchedWeights(std::int64_t step, std::int64_t count, std::int64_t steps)
{
  const double end = grading(count, steps);
  StepWeights weights = multistepWeights(step, steps);
  weights.Time = step + 1 == count ? 1.0 : weights.Time / end;
  weights.Length /= end;
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
