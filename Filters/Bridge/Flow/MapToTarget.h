// SPDX-License-Identifier: BSD-3-Clause
// The map from one density to another: the worker of vtkTransportMap with a Target.
#ifndef RectifiedTransport_MapToTarget_h
#define RectifiedTransport_MapToTarget_h

#include "Bridge/Flow/TransportMap.h"

namespace RectifiedTransport::Bridge
{

struct DensityPair;
class TargetTransport;

// As TransportMap::Run, with samples on the domain of the source. Flow of the report is that of the
// source, and ToTarget that of the target. Backward and EqualizeAreas have no effect. Collective.
// Throws Failure and Cancelled.
TransportMap::Report runToTarget(const TransportMap& map, const DensityPair& pair,
  const std::array<int, 6>& wanted, FlowCache& cache, TargetTransport& kept, Progress& progress,
  vtkImageData* output);

} // namespace RectifiedTransport::Bridge

#endif
