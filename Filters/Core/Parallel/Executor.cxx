// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Executor.h"

#include <algorithm>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace RectifiedTransport
{

void SerialExecutor::For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const
{
  for (std::int64_t first = 0; first < count; first += grain)
  {
    kernel(first, std::min(first + grain, count));
  }
}

void OpenMPExecutor::For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const
{
  KernelFailure failure;
  const std::int64_t ranges = (count + grain - 1) / grain;
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic, 1) if (ranges > 1)
#endif
  for (std::int64_t range = 0; range < ranges; ++range)
  {
    if (failure.HasHappened())
    {
      continue;
    }
    try
    {
      kernel(range * grain, std::min((range + 1) * grain, count));
    }
    catch (...)
    {
      failure.Keep();
    }
  }
  failure.Rethrow();
}

int OpenMPExecutor::Concurrency() const
{
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

} // namespace RectifiedTransport
