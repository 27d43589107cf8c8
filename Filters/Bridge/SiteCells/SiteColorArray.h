// SPDX-License-Identifier: BSD-3-Clause
// An array of a labelled image to colour its site cells by.
#ifndef RectifiedTransport_SiteColorArray_h
#define RectifiedTransport_SiteColorArray_h

#include "Bridge/VTKCompatibility.h"

#include "vtkType.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;

// Adds the cell array SiteColor, bytes that differ between neighbours, to an image whose cell
// scalars are SiteId. Throws Failure and Cancelled.
void addSiteColors(vtkImageData* labels, vtkIdType sites, Progress& progress);

} // namespace RectifiedTransport

#endif
