// SPDX-License-Identifier: BSD-3-Clause
// What a device does of a flow. Libraries of devices implement it.
#ifndef RectifiedTransport_DeviceFlow_h
#define RectifiedTransport_DeviceFlow_h

#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/FlowMap.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/Particles/ParticleSource.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/Density.h"
#include "Core/Tables/SummedAreaTables.h"

#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

class DeviceUse;

// One advection, on the tables of one density.
template <int Dimension>
class DeviceAdvection
{
public:
  DeviceAdvection() = default;
  virtual ~DeviceAdvection() = default;
  DeviceAdvection(const DeviceAdvection&) = delete;
  DeviceAdvection& operator=(const DeviceAdvection&) = delete;

  // The fewest particles that are worth a run of kernels.
  virtual std::int64_t FewestParticles() const = 0;
  // Advects the particles [first, first + count) of the source's chunk, or the points of a whole
  // lattice in the order of its cells, and writes their positions; adds to the counts. Returns
  // false where the device does not serve, or not any more: nothing of an array is written then,
  // those of a lattice are undefined, and no further call does more. Once the progress is to stop,
  // positions are undefined.
  virtual bool Run(const ParticleSource<Dimension>& source, std::int64_t first, std::int64_t count,
    double* positions, FlowReport& counts, Progress& progress) = 0;
};

// What a device keeps of a flow: its tables, and the map of the last run in either direction. `use`
// is a use of that device.
template <int Dimension>
class DeviceFlow
{
public:
  DeviceFlow() = default;
  virtual ~DeviceFlow() = default;
  DeviceFlow(const DeviceFlow&) = delete;
  DeviceFlow& operator=(const DeviceFlow&) = delete;

  // Whether the device does such advections, to time 1 or back to 0.
  virtual bool Serves(AdvectionKind kind, const FlowOptions& options) const = 0;

  // Makes the tables of a density, if `use` serves: less is transferred than from those of the
  // processor, which are given. Throws Cancelled.
  virtual void MakeTables(DeviceUse& use, const DensitySource<Dimension>& density,
    const SummedAreaTables<Dimension>& tables, Progress& progress) = 0;

  // An advection with a map, or none; null where `use` does not serve, or the progress is to stop
  // before another thread leaves the device. All must outlive it. Advections of several threads may
  // be under way.
  virtual std::unique_ptr<DeviceAdvection<Dimension>> Begin(DeviceUse& use,
    const AdvectionJob<Dimension>& job, std::shared_ptr<const FlowMap<Dimension>> map,
    Progress& progress) = 0;

  // The nodes of maps of such an advection.
  virtual DeviceNodes<Dimension> BeginNodes(DeviceUse& use, const AdvectionJob<Dimension>& job) = 0;
};

} // namespace RectifiedTransport

#endif
