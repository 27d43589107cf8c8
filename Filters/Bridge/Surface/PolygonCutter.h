// SPDX-License-Identifier: BSD-3-Clause
// Cuts polygons into triangles, even with coincident or collinear corners.
#ifndef RectifiedTransport_PolygonCutter_h
#define RectifiedTransport_PolygonCutter_h

#include "Bridge/VTKCompatibility.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolygon.h"
#include "vtkType.h"

#include <array>
#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// vtkPolygon drops polygons with coincident corners, which Clip and Slice make where they pass
// through a point. Here these corners are removed first and come back as triangles without area, so
// that every edge of the polygon is an edge of a triangle.
class PolygonCutter
{
public:
  // Coordinates of coincident corners differ by at most `rounding` along each axis.
  PolygonCutter(vtkPoints* points, double rounding);

  // Appends a triangle for each corner beyond the second. Returns whether that was possible; it is
  // not if edges cross.
  bool Cut(vtkIdType count, const vtkIdType* corners, vtkCellArray* triangles);

private:
  using Ring = std::vector<std::size_t>; // corners by their places in the polygon

  bool CutRing(const Ring& ring);
  Ring WithoutEqual(const Ring& ring) const;
  Ring WithoutStraight(const Ring& ring) const;
  bool IsSamePlace(std::size_t a, std::size_t b) const;
  bool IsStraight(std::size_t a, std::size_t b, std::size_t c) const;
  void Append(const Ring& ring, const vtkIdType* corners, vtkCellArray* triangles) const;

  vtkPoints* const Points;
  const double Rounding;
  double Size = 0.0;                          // of the polygon's bounds
  std::vector<std::array<double, 3>> Corners; // of the polygon
  vtkNew<vtkPolygon> Polygon;
  vtkNew<vtkPoints> IgnoredPoints;
  vtkNew<vtkIdList> Ids; // of the triangles of the last ring, three places in it each
};

} // namespace RectifiedTransport::Bridge

#endif
