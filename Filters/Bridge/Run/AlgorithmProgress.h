// SPDX-License-Identifier: BSD-3-Clause
// Progress and abort of a vtkAlgorithm, as the core hears and says them.
#ifndef RectifiedTransport_AlgorithmProgress_h
#define RectifiedTransport_AlgorithmProgress_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Executor.h"

#include <cstdint>
#include <thread>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Lives on the thread that runs the algorithm.
class AlgorithmProgress
{
public:
  explicit AlgorithmProgress(vtkAlgorithm* host)
    : Host(host)
    , HostThread(std::this_thread::get_id())
  {
  }

  // From here on the work of a stage takes progress from where it is to `end`.
  void BeginStage(double end)
  {
    this->Begin = this->End;
    this->End = end;
  }

  // The progress at the end of the current stage.
  double Reached() const { return this->End; }

  // For the core's work of the current stage.
  Monitor GetMonitor();

  // Runs a kernel over [0, count), cut at multiples of `grain`, as the work of the current stage.
  // The first slice has `units`, which should take a few milliseconds (by default for work that is
  // bound by memory), and a range for every thread. Throws Aborted, and what the kernel throws.
  void Run(const Executor& executor, std::int64_t count, std::int64_t grain, RangeKernel kernel,
    std::int64_t units = std::int64_t{ 1 } << 18);

  // Whether the host wants to stop; kernels that take long may ask, on any thread.
  bool IsCancelled() const;

private:
  vtkAlgorithm* Host;
  std::thread::id HostThread;
  double Begin = 0.0;
  double End = 0.0;
  double Said = 0.0;
};

} // namespace RectifiedTransport

#endif
