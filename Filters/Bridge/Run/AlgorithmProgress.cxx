// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/AlgorithmProgress.h"

#include "Bridge/Run/SMPExecutor.h"

#include "vtkAlgorithm.h"

#include <thread>
#include <utility>

namespace RectifiedTransport
{

namespace
{

Context contextOf(vtkAlgorithm* algorithm, const Executor& threads)
{
  return Context(
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
}

} // namespace

AlgorithmProgress::AlgorithmProgress(vtkAlgorithm* algorithm, int threading)
  : AlgorithmProgress(algorithm, makeExecutor(threading))
{
}

AlgorithmProgress::AlgorithmProgress(vtkAlgorithm* algorithm, std::unique_ptr<Executor> threads)
  : Progress(contextOf(algorithm, *threads))
  , OwnThreads(std::move(threads))
{
}

} // namespace RectifiedTransport
