// SPDX-License-Identifier: BSD-3-Clause
// What the cells of sites weigh, where their middles are, and what the way to the sites costs.
#ifndef RectifiedTransport_SiteCellStatistics_h
#define RectifiedTransport_SiteCellStatistics_h

#include "Bridge/SiteCells/SiteLabels.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"
#include "Core/SiteCells/SiteDensity.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPointData;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// |x|_p^q in physical space.
struct CostNorm
{
  double Norm = 2.0;     // p, at least 1; may be infinite
  double Exponent = 2.0; // q, above 0
};

// Adds `CellMass`, `CellCentroid` and `CellCost` to the sites' data. Returns the cost: the mean of
// |x - site|_p^q over the pixels' centres x. Throws Failure for a cost past the largest double or
// memory that is not there, and Cancelled.
template <int D>
double writeSiteCellStatistics(vtkPointSet* sites, const SiteDensity<D>& grid,
  const ImageGrid& geometry, const SiteIdArray* labels, const CostNorm& norm, Progress& progress,
  vtkPointData* output);

} // namespace RectifiedTransport

#endif
