// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

Progress::Progress(Context context)
  : Parent(std::move(context))
{
}

// A context for a part of the work, which reports to this object.
Progress::operator Context()
{
  Context part(
    *this->Parent.Threads, [this](double fraction) { this->Report(fraction); },
    this->Parent.IsCancelled);
  part.Group = this->Parent.Group;
  part.Device = this->Parent.Device;
  return part;
}

// Several loops share these units; the fraction starts at 0 again.
Progress& Progress::Expect(std::int64_t units)
{
  this->Units = std::max<std::int64_t>(units, 1);
  this->HasUnits = true;
  this->Done = 0;
  this->SliceUnits = 0;
  this->Pending = 0;
  this->SliceStart = Clock::now();
  return *this;
}

// Work with threads, in slices between which progress is reported and cancellation polled.
void Progress::For(std::int64_t count, std::int64_t grain, RangeKernel kernel, std::int64_t units)
{
  this->Run(*this->Parent.Threads, count, grain, kernel, units);
}

// The same on this thread, in order.
void Progress::ForInOrder(
  std::int64_t count, std::int64_t grain, RangeKernel kernel, std::int64_t units)
{
  this->Run(SerialExecutor(), count, grain, kernel, units);
}

// A slice takes about sliceSeconds: its size follows the pace of the slice before, so that loops of
// any speed are polled about equally often.
void Progress::Run(const Executor& executor, std::int64_t count, std::int64_t grain,
  const RangeKernel& kernel, std::int64_t units)
{
  if (!this->HasUnits)
  {
    this->Units = std::max<std::int64_t>(count, 1);
    this->Done = 0;
  }
  this->SliceUnits = 0;
  // Ranges for all threads, however few units of work there are.
  const std::int64_t ranges =
    std::max<std::int64_t>((units + grain - 1) / grain, executor.Concurrency());
  // To call threads takes longer than a slice of less than some 20 microseconds, a small part of
  // those that `units` take; more so where other programs keep the processors busy.
  constexpr std::int64_t shortParts = 64;
  const SerialExecutor here;
  for (std::int64_t begin = 0; begin < count;)
  {
    const std::int64_t slice = std::min(count - begin, this->NextSlice(ranges * grain));
    const bool isShort = slice < units / shortParts;
    (isShort ? here : executor).For(slice, grain, [&](std::int64_t first, std::int64_t last) {
      kernel(begin + first, begin + last);
    });
    begin += slice;
    this->EndSlice(slice);
  }
}

// Whole chunks, so that the division into chunks does not depend on the pace.
std::int64_t Progress::NextSlice(std::int64_t smallest)
{
  this->SliceUnits = std::max(this->SliceUnits / smallest, std::int64_t{ 1 }) * smallest;
  this->SliceStart = Clock::now();
  return this->SliceUnits;
}

void Progress::EndSlice(std::int64_t units)
{
  // Often enough for an abort, seldom enough to cost nothing.
  constexpr double sliceSeconds = 0.03;
  this->Done += units;
  this->Report(std::min(static_cast<double>(this->Done) / static_cast<double>(this->Units), 1.0));
  this->Poll();
  const double seconds = std::chrono::duration<double>(Clock::now() - this->SliceStart).count();
  // The pace may change by at most a factor 4 from slice to slice, which damps interruptions.
  const double factor = std::min(std::max(sliceSeconds / std::max(seconds, 1e-9), 0.25), 4.0);
  this->SliceUnits = static_cast<std::int64_t>(
    std::min(static_cast<double>(units) * factor, static_cast<double>(this->Units)) + 1.0);
  if (this->IsCancelled())
  {
    throw Cancelled();
  }
}

void Progress::Add(std::int64_t units)
{
  // Units between two reports of loops that count for themselves.
  constexpr std::int64_t interval = std::int64_t{ 1 } << 16;
  this->Pending += units;
  if (this->Pending >= interval)
  {
    this->EndSlice(std::exchange(this->Pending, 0));
  }
}

// One thread polls at a time, the others read the flag.
bool Progress::ShouldStop()
{
  if (this->Parent.IsCancelled && !this->IsPolling.test_and_set(std::memory_order_acquire))
  {
    this->Poll();
    this->IsPolling.clear(std::memory_order_release);
  }
  return this->IsCancelled();
}

// Hosts take reports on the thread that called alone.
void Progress::ReportFrom(double fraction)
{
  if (std::this_thread::get_id() == this->Caller)
  {
    this->Report(fraction);
  }
}

void Progress::Check()
{
  if (this->ShouldStop())
  {
    throw Cancelled();
  }
}

// Never decreases, though the work may consist of several loops.
void Progress::Report(double fraction)
{
  this->Reported = std::max(this->Reported, fraction);
  if (this->Parent.Report)
  {
    this->Parent.Report(this->Reported);
  }
}

void Progress::Poll()
{
  if (this->Parent.IsCancelled && this->Parent.IsCancelled())
  {
    this->Stop.store(true, std::memory_order_relaxed);
  }
}

} // namespace RectifiedTransport
