// SPDX-License-Identifier: BSD-3-Clause
// Whole updates of a filter.
#ifndef RectifiedTransport_FilterRuns_h
#define RectifiedTransport_FilterRuns_h

#include <benchmark/benchmark.h>

#include <vtkGuardedAlgorithm.h>

namespace RectifiedTransport
{

// On one thread, each after what is new to the filter was said to have changed.
inline void timeUpdates(benchmark::State& state, vtkGuardedAlgorithm* filter, vtkObject* changed)
{
  filter->SetThreadingToSerial();
  for (auto _ : state)
  {
    changed->Modified();
    filter->Update();
  }
}

} // namespace RectifiedTransport

#endif
