// SPDX-License-Identifier: BSD-3-Clause
// Moves points so that a density becomes uniform: the worker of vtkDensityEqualizingWarp.
#ifndef RectifiedTransport_DensityEqualizingWarp_h
#define RectifiedTransport_DensityEqualizingWarp_h

#include "Bridge/Density/DensityPlan.h"
#include "Bridge/Flow/MeshInversion.h"
#include "Bridge/Run/Settings/OptimalSettings.h"
#include "Bridge/Run/Settings/TableSettings.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"

#include <cstdint>

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
struct DensityEqualizingWarp
{
  FlowOptions Flow;
  TableSetting Tables;
  OptimalSetting Optimal;
  double Blend;
  bool EqualizeAreas;

  struct Report
  {
    std::int64_t Outside = 0; // points of this rank outside the domain
    InvertedCells Cells;      // of this rank's input
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
