// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_OutlineFilling_h
#define RectifiedTransport_OutlineFilling_h

#include "Bridge/VTKCompatibility.h"

#include "vtkRectifiedTransportDrawingModule.h" // for the export macro

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Adds triangles to the closed lines of the data, region by region, as OutlineRegions.h says, and
// closed lines around their polygons, which become triangles, too: what views draw of a polygon
// that is not convex may be wrong. What is inside a polygon or a region follows from the even-odd
// rule; where edges cross there is a new point. The new cells have the cell data of a line of their
// region, or of their polygon. Exported for the plugin. Throws as findOutlineRegions.
VTKRECTIFIEDTRANSPORTDRAWING_EXPORT void fillOutlines(vtkPolyData* data);

} // namespace RectifiedTransport::Bridge

#endif
