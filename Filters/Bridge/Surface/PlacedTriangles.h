// SPDX-License-Identifier: BSD-3-Clause
// Triangles that points are placed on, and where they are in the input.
#ifndef RectifiedTransport_PlacedTriangles_h
#define RectifiedTransport_PlacedTriangles_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Mesh/PlaceOnTriangle.h"
#include "Core/Mesh/TriangleSurface.h"

#include "vtkType.h"

#include <array>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

struct SurfaceAreas
{
  const double* Shares; // of the triangles; they sum to 1
  double Total;         // in units of Unit^2
  double Unit;          // in units of the input
};

// Interpolates linearly between three points of the input.
struct PointWeights
{
  std::array<std::int64_t, 3> Points;
  std::array<double, 3> Weights;
};

class PlacedTriangles
{
public:
  virtual ~PlacedTriangles() = default;

  // See TriangulatedSurface.
  virtual vtkPolyData* Triangulated() const = 0;
  virtual std::int64_t NumberOfTriangles() const = 0;
  // The points of the input at the corners of a triangle.
  virtual std::array<std::int64_t, 3> CornersOf(std::int64_t triangle) const = 0;
  // Whether a triangle is part of one that was cut at T-junctions.
  virtual bool IsPart(std::int64_t) const { return false; }
  // The points and weights of a place in its cell, as it was before cutting.
  virtual PointWeights InCell(const PlaceOnTriangle& place) const
  {
    return { this->CornersOf(place.Triangle), place.Weights };
  }
  // The cell of Triangulated() that a triangle is, or is part of.
  virtual vtkIdType CellOf(std::int64_t triangle) const = 0;
  // The cell of the input that a triangle was cut from.
  virtual vtkIdType InputCellOf(std::int64_t triangle) const = 0;
  // The triangles in units of Areas().Unit, from the centre of their bounds.
  virtual TriangleSurface Surface() const = 0;
  virtual SurfaceAreas Areas() const = 0;
};

} // namespace RectifiedTransport::Bridge

#endif
