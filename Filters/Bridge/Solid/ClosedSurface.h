// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a vtkPolyData as a closed surface of triangles.
#ifndef RectifiedTransport_ClosedSurface_h
#define RectifiedTransport_ClosedSurface_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"
#include "Core/Solid/ClosedMesh.h"

#include <array>
#include <cstdint>
#include <optional>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class ImageGrid;

// The bounds of the points that polygons and strips use; the first is above the second if there are
// none.
std::array<double, 6> polygonBounds(vtkPolyData* surface);

class ClosedSurface
{
public:
  // Merges points of equal coordinates and cuts polygons and strips into triangles, as stages of
  // the run up to the progress `end`; lines and vertices do not count. Throws Failure where the
  // input has no polygons, coordinates that are not finite, or edges of other than two triangles,
  // and Cancelled.
  ClosedSurface(vtkPolyData* input, Progress& progress, double end);

  // Returns the surface in the index coordinates of a grid, the triangles of each component with
  // one orientation, as stages up to the progress `end`. Throws Failure where a component is not
  // orientable, and Cancelled.
  TriangleSurface InCells(const ImageGrid& grid, Progress& progress, double end);

private:
  void ReadTriangles(vtkCellArray* triangles, Progress& progress);
  void RequireClosed() const;

  std::int64_t NumberOfPoints;
  std::optional<ClosedMesh> Mesh;
};

} // namespace RectifiedTransport

#endif
