// SPDX-License-Identifier: BSD-3-Clause
// Compares particles with a density: the worker of vtkTransportQuality.
#ifndef RectifiedTransport_TransportQuality_h
#define RectifiedTransport_TransportQuality_h

#include "Bridge/Plan/FlowCache.h"
#include "Bridge/Ranks/DistributedPoints.h"
#include "Bridge/Run/Settings/TransportSettings.h"
#include "Core/Quality/ParticleQuality.h"

namespace RectifiedTransport::Bridge
{

// The members are the properties of that class.
struct TransportQuality
{
  int BlockSize;
  TableSetting Tables;

  // Compares the particles of all ranks, at least one, with a density, whose tables are kept in the
  // cache. Collective on the ranks of the progress. Throws Failure, std::overflow_error and
  // Cancelled.
  ParticleQuality Run(const DistributedPoints& particles, InputDensity& density, FlowCache& cache,
    Progress& progress) const;
};

} // namespace RectifiedTransport::Bridge

#endif
