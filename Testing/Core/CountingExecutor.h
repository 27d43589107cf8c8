// SPDX-License-Identifier: BSD-3-Clause
// An executor on the calling thread that counts its loops, which others would give to threads.
#ifndef CountingExecutor_h
#define CountingExecutor_h

#include "Core/Parallel/Executor.h"

#include <cstdint>

namespace RectifiedTransport
{

class CountingExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override
  {
    ++this->Calls;
    SerialExecutor().For(count, grain, kernel);
  }
  int Concurrency() const override { return 2; }

  mutable int Calls = 0;
};

} // namespace RectifiedTransport

#endif
