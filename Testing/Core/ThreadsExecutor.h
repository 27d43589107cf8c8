// SPDX-License-Identifier: BSD-3-Clause
// OpenMP's executor with a number of threads of the test's choice.
#ifndef ThreadsExecutor_h
#define ThreadsExecutor_h

#include "Core/Parallel/Executor.h"

#include <cstdint>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace RectifiedTransport
{

class ThreadsExecutor final : public Executor
{
public:
  explicit ThreadsExecutor(int threads)
    : Threads(threads)
  {
  }
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override
  {
    const Setting setting(this->Threads);
    OpenMPExecutor().For(count, grain, kernel);
  }
  int Concurrency() const override
  {
    const Setting setting(this->Threads);
    return OpenMPExecutor().Concurrency();
  }

private:
  struct Setting
  {
#ifdef _OPENMP
    explicit Setting(int threads)
      : Before(omp_get_max_threads())
    {
      omp_set_num_threads(threads);
    }
    ~Setting()
    {
      omp_set_num_threads(this->Before);
    }
    int Before;
#else
    explicit Setting(int) {}
#endif
  };
  int Threads;
};

} // namespace RectifiedTransport

#endif
