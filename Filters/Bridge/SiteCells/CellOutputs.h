// SPDX-License-Identifier: BSD-3-Clause
// The output data sets of vtkEqualMassCells.
#ifndef RectifiedTransport_CellOutputs_h
#define RectifiedTransport_CellOutputs_h

#include "Bridge/VTKCompatibility.h"
#include "Core/SiteCells/SiteCellOutlines.h"
#include "Core/SiteCells/SiteCellPolygons.h"
#include "Core/SiteCells/SiteCellStatistics.h"

#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkType.h"

#include <array>
#include <functional>
#include <type_traits>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkImageData;
class vtkPointSet;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

using SiteIdArray =
  std::conditional_t<std::is_same_v<std::int64_t, long>, vtkLongArray, vtkLongLongArray>;

struct CellOutputs
{
  vtkImageData* Labels;
  vtkPointSet* Sites;
  vtkPolyData* Outlines;
  vtkPolyData* Polygons;

  std::array<vtkDataObject*, 4> All() const;
};

// Points in double precision, and all data.
void writeSites(vtkPointSet* sites, vtkPointSet* output);

// Adds the arrays of the sites' cells to the sites' point data; measure(statistics) fills them and
// returns the cost.
void addStatistics(
  const CellOutputs& outputs, const std::function<double(const SiteCellStatistics&)>& measure);

template <int Dimension>
void writeOutlines(SiteCellOutlines<Dimension> outlines, vtkPolyData* output);

// With the data of the output's sites. Throws Failure and Cancelled.
void writePolygons(SiteCellPolygons polygons, const CellOutputs& outputs, Progress& progress);

// Adds the cell array SiteColor, bytes that differ between neighbours, to the sites' cells, whose
// cell scalars are SiteId: an image and polygons. Hides pixels of no site by a ghost array. Throws
// Failure and Cancelled.
void addSiteColors(
  vtkImageData* labels, vtkPolyData* polygons, vtkIdType sites, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
