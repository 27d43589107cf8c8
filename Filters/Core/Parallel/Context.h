// SPDX-License-Identifier: BSD-3-Clause
// The executor of a computation, the ranks and the device that run it, and callbacks for its
// progress and cancellation.
#ifndef RectifiedTransport_Context_h
#define RectifiedTransport_Context_h

#include "Executor.h"

#include <functional>

namespace RectifiedTransport
{

class DeviceUse;
class Ranks;

// Thrown by a computation that was cancelled; its results are then undefined. Not an error, hence
// no std::exception.
class Cancelled
{
};

// An executor, which must outlive its use, and two functions, which may be empty and must not
// throw. By default OpenMP's threads and no functions.
struct Context
{
  Context();
  Context(const Executor& threads, // NOLINT: an executor is a context
    std::function<void(double)> report = {}, std::function<bool()> isCancelled = {});

  const Executor* Threads;
  // The ranks that run the computation together, never null. By default only this process.
  const Ranks* Group;
  // A device that may do the work of advections with the same bits, and must outlive its use
  // (DeviceUse.h); null, the default, if there is none.
  DeviceUse* Device = nullptr;
  // Called with the progress, in [0,1], only on the thread that called the library.
  std::function<void(double)> Report;
  // Returns whether to stop. Called on any thread, one at a time.
  std::function<bool()> IsCancelled;
};

} // namespace RectifiedTransport

#endif
