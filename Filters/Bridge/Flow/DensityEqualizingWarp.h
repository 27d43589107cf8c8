// SPDX-License-Identifier: BSD-3-Clause
// Moves points so that a density becomes uniform: the worker of vtkDensityEqualizingWarp.
#ifndef RectifiedTransport_DensityEqualizingWarp_h
#define RectifiedTransport_DensityEqualizingWarp_h

#include "Bridge/Flow/MeshInversion.h"
#include "Bridge/Plan/FlowCache.h"
#include "Bridge/Plan/TableChoice.h"

namespace RectifiedTransport::Bridge
{

// The members are the properties of that class.
struct DensityEqualizingWarp : TransportSettings
{
  double Blend = 1.0;
  bool EqualizeAreas = false;

  struct Report
  {
    std::int64_t Outside = 0; // points of this rank outside the domain
    InvertedCells Cells;      // counted in this rank's input
    FlowReport Flow;
    TransportReport Transport;
    bool IsUncorrected = false; // EqualizeAreas has changed nothing
  };

  // Sets the points and `Displacement` of an output that already has the rest of the input. Throws
  // Failure and Cancelled.
  Report Run(InputDensity& density, vtkPointSet* input, FlowCache& cache, Progress& progress,
    vtkPointSet* output) const;
};

} // namespace RectifiedTransport::Bridge

#endif
