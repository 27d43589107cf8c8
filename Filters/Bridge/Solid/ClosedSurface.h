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
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
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
  // vertices are ignored. If edges are then open, merges points that differ by rounding: by less
  // than 1e-9 of the longest side of the polygons' bounds; if that leaves edges open and the
  // coordinates are float, by less than 4 of their rounding errors. After each of both, if edges
  // are still open, triangles are cut at T-junctions if that closes the surface (see TJunctions.h);
  // at last also at those that gape by up to 1e-5, 1e-4, 1e-3 or 1e-2 of the longest side, the
  // least of these that closes it. Throws Failure if the input has no polygons, coordinates that
  // are not finite, or edges of an odd number of triangles, and Cancelled.
  ClosedSurface(vtkPolyData* input, Progress& progress);

  // A warning that counts T-junctions that were closed; empty if there were none.
  std::string RepairWarning() const;

  // Those of polygonBounds.
  const std::array<double, 6>& Bounds() const { return this->Box; }

  // Returns the surface in the index coordinates of a grid, the triangles of each component with
  // one orientation. Coordinates are rounded to four units in the last place of the largest one:
  // smaller differences, as between ranks, give the same bits. Throws Failure if a component is not
  // orientable, and Cancelled.
  SolidSurface InCells(const ImageGrid& grid, Progress& progress);

private:
  bool CloseNear(vtkPolyData* input, double distance, Progress& progress);
  bool CloseGaps(Progress& progress);
  bool CloseTJunctions(double distance, Progress& progress);
  void ReadPolygons(vtkPolyData* input, Progress& progress);
  void ReadTriangles(vtkCellArray* triangles, Progress& progress);
  std::string Openness() const;

  std::int64_t NumberOfPoints;
  std::array<double, 6> Box{};
  double Rounding = 0.0; // what coordinates are multiples of
  bool HasGaps = false;  // that were closed
  std::optional<ClosedMesh> Mesh;
};

} // namespace RectifiedTransport::Bridge

#endif
