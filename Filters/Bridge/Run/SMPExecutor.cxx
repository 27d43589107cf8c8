// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/SMPExecutor.h"

#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Forks.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

const char* const ThreadingTexts[] = { "Auto", "VTK", "OpenMP", "Serial" };

} // namespace

const char* threadingText(int threading)
{
  return choiceText(ThreadingTexts, threading);
}

std::unique_ptr<Executor> makeExecutor(int threading)
{
  requireChoice("Threading", threading, ThreadingTexts);
  return makeExecutor(static_cast<Threading>(threading));
}

void SMPExecutor::For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const
{
  if (forksSinceLoad() > 0)
  {
    SerialExecutor().For(count, grain, kernel);
    return;
  }
  const std::int64_t ranges = (count + grain - 1) / grain;
  // A few tasks a thread balance the load; a task for each range has more overhead than small
  // ranges have work.
  constexpr std::int64_t tasksPerThread = 8;
  const std::int64_t rangesPerTask =
    std::max<std::int64_t>(1, ranges / (tasksPerThread * this->Concurrency()));
  KernelFailure failure;
  auto task = [&](vtkIdType first, vtkIdType last) {
    try
    {
      for (std::int64_t range = first; range < last && !failure.HasHappened(); ++range)
      {
        kernel(range * grain, std::min((range + 1) * grain, count));
      }
    }
    catch (...)
    {
      failure.Keep();
    }
  };
  if (ranges <= 1)
  {
    task(0, ranges);
  }
  else
  {
    vtkSMPTools::For(0, ranges, rangesPerTask, task);
  }
  failure.Rethrow();
}

int SMPExecutor::Concurrency() const
{
  return forksSinceLoad() > 0 ? 1 : std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
}

std::unique_ptr<Executor> makeExecutor(Threading threading)
{
  if (threading == Threading::Auto)
  {
    threading =
      std::string(vtkSMPTools::GetBackend()) == "Sequential" ? Threading::OpenMP : Threading::VTK;
  }
  switch (threading)
  {
    case Threading::VTK:
      return std::make_unique<SMPExecutor>();
    case Threading::OpenMP:
      return std::make_unique<OpenMPExecutor>();
    default:
      return std::make_unique<SerialExecutor>();
  }
}

void withThreadsOfThisProcess(const std::function<void()>& function)
{
  if (forksSinceLoad() == 0)
  {
    function();
    return;
  }
  vtkSMPTools::LocalScope(vtkSMPTools::Config("Sequential"), function);
}

} // namespace RectifiedTransport::Bridge
