// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/AlgorithmProgress.h"

#include "Bridge/Run/SMPExecutor.h"

#include "vtkAlgorithm.h"

#include <thread>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

Context contextOf(
  vtkAlgorithm* algorithm, const Executor& threads, const Ranks& group, DeviceUse* device)
{
  Context context(
    threads, [algorithm](double fraction) { algorithm->UpdateProgress(fraction); },
    [algorithm, thread = std::this_thread::get_id()]() {
      (void)thread;
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_CHECK_ABORT
      // CheckAbort reads upstream algorithms and writes to the outputs: not thread-safe.
      if (std::this_thread::get_id() == thread)
      {
        return algorithm->CheckAbort() != 0;
      }
#endif
      return algorithm->GetAbortExecute() != 0;
    });
  context.Group = &group;
  context.Device = device;
  return context;
}

} // namespace

AlgorithmProgress::AlgorithmProgress(
  vtkAlgorithm* algorithm, int threading, const Ranks& group, DeviceUse* device)
  : AlgorithmProgress(algorithm, makeExecutor(threading), group, device)
{
}

AlgorithmProgress::AlgorithmProgress(
  vtkAlgorithm* algorithm, std::unique_ptr<Executor> threads, const Ranks& group, DeviceUse* device)
  : Progress(contextOf(algorithm, *threads, group, device))
  , OwnThreads(std::move(threads))
{
}

} // namespace RectifiedTransport::Bridge
