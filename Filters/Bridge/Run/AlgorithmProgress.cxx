// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/AlgorithmProgress.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Pacer.h"

#include "vtkAlgorithm.h"

#include <algorithm>

namespace RectifiedTransport
{

Monitor AlgorithmProgress::GetMonitor()
{
  Monitor monitor;
  monitor.Progress = [this](double fraction) {
    // Several loops may be the work of one stage: what was said is not taken back.
    this->Said = std::max(this->Said, this->Begin + (this->End - this->Begin) * fraction);
    this->Host->UpdateProgress(this->Said);
  };
  monitor.Cancelled = [this]() { return this->IsCancelled(); };
  return monitor;
}

void AlgorithmProgress::Run(const Executor& executor, std::int64_t count, std::int64_t grain,
  RangeKernel kernel, std::int64_t units)
{
  const Monitor monitor = this->GetMonitor();
  Pacer pacer(monitor);
  pacer.BeginStage(1.0, count);
  // Ranges for all threads, however few units of work there are.
  const std::int64_t ranges =
    std::max<std::int64_t>((units + grain - 1) / grain, executor.Concurrency());
  const std::int64_t smallest = ranges * grain;
  for (std::int64_t begin = 0; begin < count;)
  {
    const std::int64_t slice = std::min(count - begin, pacer.NextSlice(smallest));
    executor.For(slice, grain,
      [&](std::int64_t first, std::int64_t last) { kernel(begin + first, begin + last); });
    begin += slice;
    if (!pacer.EndSlice(slice))
    {
      throw Aborted();
    }
  }
}

bool AlgorithmProgress::IsCancelled() const
{
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_CHECK_ABORT
  // CheckAbort looks upstream and marks the outputs, which is for one thread alone.
  if (std::this_thread::get_id() == this->HostThread)
  {
    return this->Host->CheckAbort();
  }
#endif
  return this->Host->GetAbortExecute() != 0;
}

} // namespace RectifiedTransport
