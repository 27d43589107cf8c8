// SPDX-License-Identifier: BSD-3-Clause
// Long work in stages, and in slices that last about as long as a host may wait for progress or an
// abort. What is computed never depends on how work is sliced.
#ifndef RectifiedTransport_Progress_h
#define RectifiedTransport_Progress_h

#include "Core/Parallel/Context.h"

#include <atomic>
#include <chrono>
#include <cstdint>

namespace RectifiedTransport
{

// Lives on the thread that called the library.
class Progress
{
public:
  explicit Progress(Context context);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  const Executor& Threads() const { return *this->Host.Threads; }

  // From here on `units` of work take the progress from where the last stage ends to `end`.
  void BeginStage(double end, std::int64_t units = 1);
  double StageEnd() const { return this->End; }
  // What the work of the current stage runs in that reports in [0,1] by itself. It has to end
  // before this object does.
  Context Stage();

  // Runs a kernel over [0, count), cut at multiples of `grain`, as the work of the current stage.
  // The first slice has `units`, which should take a few milliseconds (by default for work that is
  // bound by memory), and a range for every thread. Throws Cancelled, and what the kernel throws.
  void For(
    std::int64_t count, std::int64_t grain, RangeKernel kernel, std::int64_t units = usualUnits);
  // The same on this thread, in order.
  void ForInOrder(
    std::int64_t count, std::int64_t grain, RangeKernel kernel, std::int64_t units = usualUnits);

  // How many units the caller's next slice may take, at least `smallest`, in multiples of it.
  std::int64_t NextSlice(std::int64_t smallest);
  // Reports units as done. Throws Cancelled.
  void EndSlice(std::int64_t units);
  // For small pieces of work, which need not begin slices: now and then the host hears of them.
  // Throws Cancelled.
  void Add(std::int64_t units);

  // Asks the host. Throws Cancelled.
  void Check();

  // For range kernels: asks the host now and then, one thread at a time. The slice's end throws.
  bool ShouldStop();
  bool IsCancelled() const { return this->Stop.load(std::memory_order_relaxed); }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::int64_t usualUnits = std::int64_t{ 1 } << 18;

  void Run(const Executor& executor, std::int64_t count, std::int64_t grain,
    const RangeKernel& kernel, std::int64_t units);
  void Report(double fractionOfStage);
  void Ask();

  const Context Host;
  double Reported = 0.0;
  double Begin = 0.0;
  double End = 0.0;
  std::int64_t Units = 1;
  std::int64_t Done = 0;
  std::int64_t SliceUnits = 0;
  std::int64_t Pending = 0; // of Add
  Clock::time_point SliceStart = Clock::now();
  std::atomic_flag Asking = ATOMIC_FLAG_INIT;
  std::atomic<bool> Stop{ false };
};

} // namespace RectifiedTransport

#endif
