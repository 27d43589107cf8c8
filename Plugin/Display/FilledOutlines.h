// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_FilledOutlines_h
#define RectifiedTransport_FilledOutlines_h

class vtkPolyData;

namespace RectifiedTransport
{

// Adds triangles to the closed lines of the data, region by region, as
// Bridge/Drawing/OutlinedRegions.h says, and closed lines around their polygons, which become
// triangles, too: what views draw of a polygon that is not convex may be wrong. The new cells have
// the cell data of a line of their region, or of their polygon.
void fillOutlines(vtkPolyData* data);

} // namespace RectifiedTransport

#endif
