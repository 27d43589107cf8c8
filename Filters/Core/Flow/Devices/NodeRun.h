// SPDX-License-Identifier: BSD-3-Clause
// The kernel that makes the nodes of a level of a flow map, with its arguments.
#ifndef RectifiedTransport_NodeRun_h
#define RectifiedTransport_NodeRun_h

#include "Core/Device/Device.h"
#include "Core/Flow/Devices/KernelRun.h"
#include "Core/Flow/Kernels/FlowKernels.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class NodeRun
{
public:
  // Of the levels that the map has so far, which are copied. Throws DeviceError.
  NodeRun(Device& device, const DeviceProgram& program, const FlowJob<Dimension>& job,
    std::shared_ptr<const DeviceTables<Dimension>> tables, const FlowMapView<Dimension>& map,
    const FlowMapLevel<Dimension>& level);

  // The fewest nodes of a run.
  std::int64_t FewestNodes() const { return this->Fewest; }
  // Makes the records of the nodes [first, first + count) of the level, and their marks. Returns
  // the number of velocity evaluations. Throws DeviceError.
  std::int64_t Run(Device& device, std::int64_t first, std::int64_t count, unsigned char* marks);

private:
  const FlowMapLevel<Dimension> Level;
  const std::int64_t Steps; // of particles
  const int LevelCount;
  const std::int64_t Record; // floats
  const std::shared_ptr<const DeviceTables<Dimension>> Tables;
  const DeviceMap<Dimension> Coarser;
  DeviceKernel Advance;
  DeviceBuffer Input;
  DeviceBuffer OfParticles; // weights
  DeviceBuffer OfNodes;
  DeviceBuffer StepsOfNodes;
  DeviceBuffer Places;
  std::int64_t Fewest = 0;
  // Of the nodes of a run.
  std::int64_t Room = 0;
  DeviceBuffer Records;
  DeviceBuffer Marks;
  DeviceBuffer Status;
  std::vector<std::uint32_t> Counts;
};

} // namespace RectifiedTransport

#endif
