// SPDX-License-Identifier: BSD-3-Clause
// Moves points so that a density becomes uniform: the worker of vtkDensityEqualizingWarp.
#ifndef RectifiedTransport_DensityEqualizingWarp_h
#define RectifiedTransport_DensityEqualizingWarp_h

#include "Bridge/Plan/FlowCache.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/InvertedCells.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Counts cells of as many dimensions as the grid: lines, polygons seen along the grid's normal, or
// volumes, by the simplices that VTK divides them into. Ghost cells do not count, nor cells that it
// cannot divide. `before` has the cells, `after` the moved points. Throws Failure and Cancelled.
InvertedCells countInvertedCells(
  const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after, Progress& progress);

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
