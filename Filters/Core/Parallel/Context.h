// SPDX-License-Identifier: BSD-3-Clause
// The executor of a computation, the processes that share it, and callbacks for its progress and
// cancellation.
#ifndef RectifiedTransport_Context_h
#define RectifiedTransport_Context_h

#include "Core/Parallel/Executor.h"

#include <functional>

namespace RectifiedTransport
{

class Ranks;

// Thrown by a computation that was cancelled; its results are then undefined. Not an error, hence
// no std::exception.
class Cancelled
{
};

// An executor, which has to outlive its use, and two functions, which may be empty and may not
// throw. By default OpenMP's threads and no functions.
struct Context
{
  Context();
  Context(const Executor& threads) // NOLINT: an executor is a context
    : Threads(&threads)
  {
  }
  Context(const Executor& threads, std::function<void(double)> report,
    std::function<bool()> isCancelled = {});

  const Executor* Threads;
  // The processes that run the computation together; nullptr for this one alone.
  const Ranks* Group = nullptr;
  // Called with the progress, in [0,1], on the thread that called the library only.
  std::function<void(double)> Report;
  // Returns whether to stop. Called on any thread, by one at a time.
  std::function<bool()> IsCancelled;
};

} // namespace RectifiedTransport

#endif
