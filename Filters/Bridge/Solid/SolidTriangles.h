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

namespace RectifiedTransport::Bridge
{

// The triangles of all polygons and strips, on the merged points of a mesh. Consecutive corners at
// the same point are dropped, as at the poles of a sphere of quads, and so are polygons with fewer
// than three corners left. Thin polygons are never refused. A quad is cut along its shorter
// diagonal, if that is within it, independently of its first corner. Larger polygons are cut by
// vtkTriangleFilter; if that fails, into a fan. The fan of a planar polygon has the same winding
// number, whatever the polygon's shape. Throws Failure if there is no memory, and Cancelled.
vtkSmartPointer<vtkCellArray> cutIntoTriangles(
  vtkPolyData* surface, const ClosedMesh& mesh, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
