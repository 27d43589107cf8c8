// SPDX-License-Identifier: BSD-3-Clause
// The Progress of one execution of a vtkAlgorithm: progress events, abort checks and the executor
// that its property Threading chooses.
#ifndef RectifiedTransport_AlgorithmProgress_h
#define RectifiedTransport_AlgorithmProgress_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Ranks.h"

#include <memory>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class DeviceUse;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Construct it on the thread that executes the algorithm.
class AlgorithmProgress final : public Progress
{
public:
  // `threading` is a value of vtkCollectiveAlgorithm::ThreadingType; others throw Failure. `group`:
  // the ranks that run the algorithm together. `device`: what may do its advections, and must
  // outlive this; none if null.
  AlgorithmProgress(vtkAlgorithm* algorithm, int threading, const Ranks& group = SoloRanks::Get(),
    DeviceUse* device = nullptr);

private:
  AlgorithmProgress(vtkAlgorithm* algorithm, std::unique_ptr<Executor> threads, const Ranks& group,
    DeviceUse* device);

  const std::unique_ptr<Executor> OwnThreads;
};

} // namespace RectifiedTransport::Bridge

#endif
