// SPDX-License-Identifier: BSD-3-Clause
// Long work in slices of about 30 ms. After each slice, progress is reported and cancellation is
// polled. Results do not depend on the slices. Work of several stages: see Stages.h.
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

  // For a computation that is this work, or a part of it: it reports to this object, which never
  // goes back. Must not outlive this object.
  operator Context(); // NOLINT: whoever runs a computation decides what is reported

  // The loops that follow are parts of so many units of work together. Without it each loop counts
  // as the whole work. Returns this object.
  Progress& Expect(std::int64_t units);

  // Runs a kernel over [0, count), in ranges of `grain`, as all of the work, or as `count` of the
  // units that are expected. The first slice has `units`, which should take a few milliseconds (the
  // default is for memory-bound work), and a range for every thread. Throws Cancelled, and what the
  // kernel throws.
  void For(
    std::int64_t count, std::int64_t grain, RangeKernel kernel, std::int64_t units = usualUnits);
  // The same on this thread, in order.
  void ForInOrder(
    std::int64_t count, std::int64_t grain, RangeKernel kernel, std::int64_t units = usualUnits);

  // The same for a kernel(i), which is called for each i of [0, count).
  template <class Kernel>
  void ForEach(
    std::int64_t count, std::int64_t grain, const Kernel& kernel, std::int64_t units = usualUnits)
  {
    this->For(count, grain, eachOf(kernel), units);
  }
  template <class Kernel>
  void ForEachInOrder(
    std::int64_t count, std::int64_t grain, const Kernel& kernel, std::int64_t units = usualUnits)
  {
    this->ForInOrder(count, grain, eachOf(kernel), units);
  }

  // The number of units of the caller's next slice, a multiple of `smallest`.
  std::int64_t NextSlice(std::int64_t smallest);
  // Reports units as done. Throws Cancelled.
  void EndSlice(std::int64_t units);
  // Adds units of small pieces of work, without slices: reports every 2^16 units. Throws Cancelled.
  void Add(std::int64_t units);

  // Polls for cancellation. Throws Cancelled.
  void Check();
  // The same before number i of a loop, once in so many numbers.
  void CheckEvery(std::int64_t interval, std::int64_t i)
  {
    if (i % interval == 0)
    {
      this->Check();
    }
  }

  // For range kernels, on any thread: polls for cancellation, one thread at a time. EndSlice then
  // throws.
  bool ShouldStop();
  bool IsCancelled() const { return this->Stop.load(std::memory_order_relaxed); }
  // For long work within a range, on any thread: reports a fraction of the work as done. Only the
  // thread that constructed this object reports.
  void ReportFrom(double fraction);

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::int64_t usualUnits = std::int64_t{ 1 } << 18;

  // A range kernel. The copy of what the kernel captures may stay in registers.
  template <class Kernel>
  static auto eachOf(const Kernel& kernel)
  {
    return [&kernel](std::int64_t first, std::int64_t last) {
      const Kernel own = kernel;
      for (std::int64_t i = first; i < last; ++i)
      {
        own(i);
      }
    };
  }
  void Run(const Executor& executor, std::int64_t count, std::int64_t grain,
    const RangeKernel& kernel, std::int64_t units);
  void Report(double fraction);
  void Poll();

  const Context Parent;
  const std::thread::id Caller = std::this_thread::get_id();
  double Reported = 0.0;
  std::int64_t Units = 1;
  bool HasUnits = false; // otherwise each loop sets them
  std::int64_t Done = 0;
  std::int64_t SliceUnits = 0;
  std::int64_t Pending = 0; // units that Add has not reported yet
  Clock::time_point SliceStart = Clock::now();
  std::atomic_flag IsPolling = ATOMIC_FLAG_INIT;
  std::atomic<bool> Stop{ false };
};

} // namespace RectifiedTransport

#endif
