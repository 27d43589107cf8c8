// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a vtkPolyData as a closed surface of triangles.
#ifndef RectifiedTransport_ClosedSurface_h
#define RectifiedTransport_ClosedSurface_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Solid/ClosedMesh.h"

#include <array>
#include <optional>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class ImageGrid;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// The bounds of the points that polygons and strips use; the first is above the second if there are
// none.
std::array<double, 6> polygonBounds(vtkPolyData* surface);

class ClosedSurface
{
public:
  // Merges points with equal coordinates and cuts polygons and strips into triangles. Lines and
  // vertices are ignored. If edges are then open, closes them as ClosedMesh::Close does: within
  // rounding, which is 1e-9 of the longest side of the polygons' bounds or four rounding errors of
  // float coordinates, and at T-junctions that gape by up to 1e-5, 1e-4, 1e-3 or 1e-2 of
  // that side. Throws Failure if the input has no polygons, coordinates that are not finite, or
  // edges of an odd number of triangles that may not stay, after an advice, and
  // Cancelled.
  ClosedSurface(vtkPolyData* input, bool mayBeOpen, const std::string& advice, Progress& progress);

  bool IsOpen() const { return this->StaysOpen; }
  TriangleSurface Triangles() const { return this->Mesh->Surface(); }

  // A warning that counts T-junctions that were closed; empty if there were none.
  std::string RepairWarning() const;

  // Those of polygonBounds.
  const std::array<double, 6>& Bounds() const { return this->Box; }

  // Returns the surface in the index coordinates of a grid (see ClosedMesh::MoveToCells), the
  // triangles of each component with one orientation. Throws Failure if a component of a closed
  // surface is not orientable, and Cancelled.
  SolidSurface InCells(const ImageGrid& grid, Progress& progress);

private:
  std::array<double, 6> Box{};
  std::optional<ClosedMesh> Mesh;
  bool StaysOpen = false;
};

} // namespace RectifiedTransport::Bridge

#endif
