// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a closed surface as triangles.
#ifndef RectifiedTransport_SolidTriangles_h
#define RectifiedTransport_SolidTriangles_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"
#include "Core/Solid/ClosedMesh.h"

#include "vtkSmartPointer.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// The triangles of all polygons and strips, of the points that a mesh merges theirs into, as stages
// up to the progress `end`. Consecutive corners that are one point are dropped, as at the poles of
// a sphere of quads, and polygons that keep less than three. However thin, none is refused: a quad
// is cut along its shorter diagonal, if that is within it, in the same way wherever its corners
// begin; a polygon of more corners by vtkTriangleFilter, and where that fails into a fan. Of a
// planar polygon a fan has the same winding number, whatever the polygon's shape. Throws Failure
// where there is no memory, and Cancelled.
vtkSmartPointer<vtkCellArray> cutIntoTriangles(
  vtkPolyData* surface, const ClosedMesh& mesh, Progress& progress, double end);

} // namespace RectifiedTransport

#endif
