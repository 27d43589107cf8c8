// SPDX-License-Identifier: BSD-3-Clause
// Whether a filter gives the same bits with every executor and number of threads.
#ifndef ThreadsTest_h
#define ThreadsTest_h

#include "Checks.h"

#include "vtkCollectiveAlgorithm.h"
#include "vtkSMPTools.h"

#include <string>

// `run` runs the filter anew with a Threading, and gives what comes out; so does this, of one
// thread.
template <class Run>
auto expectSameBits(Checks& checks, const Run& run, int line)
{
  const auto serial = run(vtkCollectiveAlgorithm::THREADING_SERIAL);
  for (const char* backend : { "Sequential", "STDThread", "TBB", "OpenMP" })
  {
    if (!vtkSMPTools::SetBackend(backend))
    {
      continue;
    }
    for (const int threads : { 1, 2, 3 })
    {
      vtkSMPTools::Initialize(threads);
      for (const int threading : { vtkCollectiveAlgorithm::THREADING_AUTO,
             vtkCollectiveAlgorithm::THREADING_VTK, vtkCollectiveAlgorithm::THREADING_OPENMP })
      {
        checks.That(run(threading) == serial, "same bits", line,
          std::string(backend) + ", Threading " + std::to_string(threading) + ", " +
            std::to_string(threads) + " threads");
      }
    }
  }
  vtkSMPTools::Initialize(0);
  return serial;
}

#endif
