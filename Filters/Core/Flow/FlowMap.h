// SPDX-License-Identifier: BSD-3-Clause
// A flow map: lattices of seeds, advected while boxes are wide and the flow is smooth. Forward,
// particles are interpolated from it and take the last few steps; backward, they end by
// interpolation. It depends only on the density, the number of steps and the direction.
#ifndef RectifiedTransport_FlowMap_h
#define RectifiedTransport_FlowMap_h

#include "Core/Flow/FlowMapShape.h"
#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

// A device that makes the records of the nodes [first, first + count) of a level from the levels
// that the map has so far, and their marks (NodeAdvance::Run). Returns the number of velocity
// evaluations, or -1 where the device does not serve, or not any more. Throws Cancelled. May be
// empty.
template <int Dimension>
using DeviceNodes = std::function<std::int64_t(const FlowMapView<Dimension>& map,
  const FlowMapLevel<Dimension>& level, std::int64_t first, std::int64_t count,
  unsigned char* marks, Progress& progress)>;

template <int Dimension>
class FlowMap
{
public:
  // Makes all levels of a shape, on a device if one is given and serves. Forward, it stops at
  // the first level whose share of bad cells is larger than the share of the steps that it saves.
  // The job gives the tables, the direction, the steps and their weights. Collective on
  // the context's ranks. Throws std::bad_alloc and Cancelled.
  FlowMap(const FlowMapShape<Dimension>& shape, const FlowJob<Dimension>& job,
    const Context& context, const DeviceNodes<Dimension>& onDevice = {});
  FlowMap(const FlowMap&) = delete;
  FlowMap& operator=(const FlowMap&) = delete;

  const FlowMapView<Dimension>& View() const { return this->Map; }
  std::int64_t MemorySize() const; // bytes
  std::int64_t Evaluations() const { return this->Evaluated; }

private:
  struct Lattice
  {
    LargeBuffer<float> Records;
    LargeBuffer<unsigned char> Bad;
  };

  FlowMapView<Dimension> Map;
  std::vector<StepWeights> Weights;
  std::vector<Lattice> Lattices;
  std::int64_t Evaluated = 0;
};

} // namespace RectifiedTransport

#endif
