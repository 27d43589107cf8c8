// SPDX-License-Identifier: BSD-3-Clause
// The kernel that makes the nodes of flow maps, with its arguments.
#ifndef RectifiedTransport_NodeRun_h
#define RectifiedTransport_NodeRun_h

#include "Core/Device/Device.h"
#include "Core/Flow/Devices/KernelRun.h"
#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

template <int Dimension>
class NodeRun
{
public:
  // Throws DeviceError.
  NodeRun(Device& device, const DeviceProgram& program, const FlowJob<Dimension>& job,
    std::shared_ptr<const DeviceTables<Dimension>> tables);

  // DeviceNodes::Run, on a device that nobody else uses. Throws DeviceError and Cancelled.
  std::int64_t Run(Device& device, const FlowMapView<Dimension>& map,
    const FlowMapLevel<Dimension>& level, std::int64_t first, std::int64_t count,
    unsigned char* marks, Progress& progress);

private:
  const bool IsBackward;
  const std::shared_ptr<const DeviceTables<Dimension>> Tables;
  DeviceBuffer Input;
  DeviceKernel Advance;
};

} // namespace RectifiedTransport

#endif
