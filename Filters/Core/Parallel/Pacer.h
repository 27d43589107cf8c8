// SPDX-License-Identifier: BSD-3-Clause
// Long work in slices that last about as long as a host may wait for progress or an abort.
#ifndef RectifiedTransport_Pacer_h
#define RectifiedTransport_Pacer_h

#include "Core/Parallel/Executor.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>

namespace RectifiedTransport
{

// Calls the monitor between slices, on the thread that owns it, and lets range kernels ask in
// between whether they should stop. What is computed never depends on how work is sliced.
class Pacer
{
public:
  explicit Pacer(const Monitor& monitor)
    : Host(monitor)
  {
  }

  // From now on progress runs from where it is to `end` over `units` of work.
  void BeginStage(double end, std::int64_t units)
  {
    this->StageBegin = this->Fraction;
    this->StageEnd = end;
    this->Units = std::max<std::int64_t>(units, 1);
    this->Done = 0;
    this->SliceUnits = 0;
  }

  // How many units the next slice may take, at least `smallest`, in multiples of it.
  std::int64_t NextSlice(std::int64_t smallest)
  {
    this->SliceUnits = std::max(this->SliceUnits / smallest, std::int64_t{ 1 }) * smallest;
    this->SliceStart = Clock::now();
    return this->SliceUnits;
  }

  // Reports `units` as done. False if the host wants to stop.
  bool EndSlice(std::int64_t units)
  {
    this->Done += units;
    const double part = static_cast<double>(this->Done) / static_cast<double>(this->Units);
    this->Fraction = this->StageBegin + (this->StageEnd - this->StageBegin) * std::min(part, 1.0);
    if (this->Host.Progress)
    {
      this->Host.Progress(this->Fraction);
    }
    this->Ask();
    const double seconds = std::chrono::duration<double>(Clock::now() - this->SliceStart).count();
    const double factor = std::min(std::max(SliceSeconds / std::max(seconds, 1e-9), 0.25), 4.0);
    this->SliceUnits = static_cast<std::int64_t>(
      std::min(static_cast<double>(units) * factor, static_cast<double>(this->Units)) + 1.0);
    return !this->IsCancelled();
  }

  // For range kernels: asks the host now and then, one thread at a time.
  bool ShouldStop()
  {
    if (this->Host.Cancelled && !this->Asking.test_and_set(std::memory_order_acquire))
    {
      this->Ask();
      this->Asking.clear(std::memory_order_release);
    }
    return this->IsCancelled();
  }

  bool IsCancelled() const { return this->Stop.load(std::memory_order_relaxed); }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr double SliceSeconds = 0.03;

  void Ask()
  {
    if (this->Host.Cancelled && this->Host.Cancelled())
    {
      this->Stop.store(true, std::memory_order_relaxed);
    }
  }

  const Monitor& Host;
  double Fraction = 0.0;
  double StageBegin = 0.0;
  double StageEnd = 1.0;
  std::int64_t Units = 1;
  std::int64_t Done = 0;
  std::int64_t SliceUnits = 0;
  Clock::time_point SliceStart;
  std::atomic_flag Asking = ATOMIC_FLAG_INIT;
  std::atomic<bool> Stop{ false };
};

} // namespace RectifiedTransport

#endif
