// SPDX-License-Identifier: BSD-3-Clause
// Spaces points evenly for a density: the worker of vtkBlueNoiseRelaxation.
#ifndef RectifiedTransport_BridgeBlueNoiseRelaxation_h
#define RectifiedTransport_BridgeBlueNoiseRelaxation_h

#include "Bridge/Data/GhostFlags.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class InputDensity;
class FlowCache;

// The members are the properties of that class.
struct BlueNoiseRelaxation
{
  bool ByTransport; // else by repulsion
  RelaxationOptions Options;

  struct Report
  {
    std::int64_t PointsMoved = 0; // to the domain
    double Correlation = 0.0;     // of the input with the density, see BlockCorrelation
    std::vector<double> Energy;   // none if all points are ghosts
  };

  // Sets the points of an output that already has the rest of the input. Ghosts stay where they
  // are. Tables are kept in the cache; relaxation by transport needs none. Throws Failure and
  // Cancelled.
  Report Run(InputDensity& density, vtkPointSet* input, const NonGhostPoints& counted,
    FlowCache& cache, Progress& progress, vtkPointSet* output) const;
};

} // namespace RectifiedTransport::Bridge

#endif
