// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Executor.h"

#include "Core/Parallel/Forks.h"

#include <algorithm>

#ifdef _OPENMP
#include "Core/Parallel/LoopTeam.h"

#include <omp.h>
#endif

namespace RectifiedTransport
{

// Chunks of `grain`, as with threads: kernels that sum by chunks have the same bits.
void SerialExecutor::For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const
{
  for (std::int64_t first = 0; first < count; first += grain)
  {
    kernel(first, std::min(first + grain, count));
  }
}

void OpenMPExecutor::For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const
{
#ifdef _OPENMP
  const int threads = this->Concurrency();
  if (threads > 1 && count > grain)
  {
    LoopTeam::Get().Run(threads, count, grain, kernel);
    return;
  }
#endif
  SerialExecutor().For(count, grain, kernel);
}

// One thread in a parallel region, whose threads are all at work, and in a child of fork(), where
// the team's threads do not exist.
int OpenMPExecutor::Concurrency() const
{
#ifdef _OPENMP
  return forksSinceLoad() > 0 || omp_in_parallel() ? 1 : omp_get_max_threads();
#else
  return 1;
#endif
}

} // namespace RectifiedTransport
