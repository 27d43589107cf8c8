// SPDX-License-Identifier: BSD-3-Clause
// Long work in stages, and in slices of about 30 ms. After each slice, progress is reported and
// cancellation is polled. Results do not depend on the slices.
#ifndef RectifiedTransport_Progress_h
#define RectifiedTransport_Progress_h

#include "Context.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

namespace RectifiedTransport
{

// Use it on the thread that called the library, except ShouldStop, IsCancelled and ReportFrom.
class Progress
{
public:
  explicit Progress(Context context);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  const Executor& Threads() const { return *this->Parent.Threads; }
  const Ranks& Group() const { return *this->Parent.Group; }
  DeviceUse* Device() const { return this->Parent.Device; } // may be null

  // Begins a stage: its `units` of work take the progress from the end of the last stage to `end`.
  // All its loops count as a part of them; with 0 units each loop is the whole stage.
  void BeginStage(double end, std::int64_t units = 0);
  // Begins a stage for a round, from 0 on, of which nobody knows how many there will be. All rounds
  // lead from `begin` towards `end`, the first `usual` ones half of the way.
  void BeginRound(int round, int usual, double begin, double end, std::int64_t units);
  double StageEnd() const { return this->End; }
  // The context of a computation that is the work of the current stage and reports its own progress
  // in [0,1]. Must not outlive this object.
  Context Stage();

  // Runs a kernel over [0, count), in ranges of `grain`, as the work of the current stage, or as
  // `count` of its units. The first slice has `units`, which should take a few milliseconds (the
  // default is for memory-bound work), and a range for every thread. Throws Cancelled, and what the
  // kernel throws.
  void For(
    std::int64_t count, std::int64_t grain, RangeKernel kernel, std::int64_t units = usualUnits);
  // The same on this thread, in order.
  void ForInOrder(
    std::int64_t count, std::int64_t grain, RangeKernel kernel, std::int64_t units = usualUnits);

  // The number of units of the caller's next slice, a multiple of `smallest`.
  std::int64_t NextSlice(std::int64_t smallest);
  // Reports units as done. Throws Cancelled.
  void EndSlice(std::int64_t units);
  // Adds units of small pieces of work, without slices: reports every 2^16 units. Throws Cancelled.
  void Add(std::int64_t units);

  // Polls for cancellation. Throws Cancelled.
  void Check();

  // For range kernels, on any thread: polls for cancellation, one thread at a time. EndSlice then
  // throws.
  bool ShouldStop();
  bool IsCancelled() const { return this->Stop.load(std::memory_order_relaxed); }
  // For long work within a range, on any thread: reports a part of the current stage as done. Only
  // the thread that constructed this object reports.
  void ReportFrom(double fractionOfStage);

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::int64_t usualUnits = std::int64_t{ 1 } << 18;

  void Run(const Executor& executor, std::int64_t count, std::int64_t grain,
    const RangeKernel& kernel, std::int64_t units);
  void Report(double fractionOfStage);
  void Poll();

  const Context Parent;
  const std::thread::id Caller = std::this_thread::get_id();
  double Reported = 0.0;
  double Begin = 0.0;
  double End = 0.0;
  std::int64_t Units = 1;
  bool HasUnits = false; // else each loop sets them
  std::int64_t Done = 0;
  std::int64_t SliceUnits = 0;
  std::int64_t Pending = 0; // of Add
  Clock::time_point SliceStart = Clock::now();
  std::atomic_flag IsPolling = ATOMIC_FLAG_INIT;
  std::atomic<bool> Stop{ false };
};

} // namespace RectifiedTransport

#endif
