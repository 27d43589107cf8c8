// SPDX-License-Identifier: BSD-3-Clause
// An array of a labelled image to colour its site cells by.
#ifndef RectifiedTransport_SiteColorArray_h
#define RectifiedTransport_SiteColorArray_h

#include "Bridge/VTKCompatibility.h"

#include "vtkType.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Adds the cell array SiteColor, bytes that differ between neighbours, to the sites' cells, whose
// cell scalars are SiteId: an image and polygons. Hides pixels of no site by a ghost array. Throws
// Failure and Cancelled.
void addSiteColors(
  vtkImageData* labels, vtkPolyData* polygons, vtkIdType sites, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
