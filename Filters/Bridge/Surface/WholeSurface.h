// SPDX-License-Identifier: BSD-3-Clause
// All triangles of a surface of any shape.
#ifndef RectifiedTransport_WholeSurface_h
#define RectifiedTransport_WholeSurface_h

#include "Bridge/Surface/PlacedTriangles.h"
#include "Bridge/Surface/TriangulatedSurface.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <optional>

namespace RectifiedTransport::Bridge
{

class WholeSurface final : public PlacedTriangles
{
public:
  // `input` has points. Cuts polygons and strips into triangles. Ghost cells (duplicate, blanked or
  // refined) are left out, and triangles with the places of one before. Throws Failure if the input
  // has no polygons or no area, coordinates that are not finite or polygons that cannot be cut, and
  // Cancelled.
  WholeSurface(vtkPolyData* input, Progress& progress);

  vtkPolyData* Triangulated() const override { return this->Cells->Get(); }
  std::int64_t NumberOfTriangles() const override { return this->Corners.size() / 3; }
  std::array<std::int64_t, 3> CornersOf(std::int64_t triangle) const override
  {
    const std::int64_t* corners = this->Corners.data() + 3 * triangle;
    return { corners[0], corners[1], corners[2] };
  }
  vtkIdType CellOf(std::int64_t triangle) const override
  {
    return this->Cells->CellOf(this->Given(triangle));
  }
  vtkIdType InputCellOf(std::int64_t triangle) const override
  {
    return this->Cells->InputCellOf(this->Given(triangle));
  }
  TriangleSurface Surface() const override;
  // By how much the coordinates of Surface() may be off (see roundingOfCorners).
  double Rounding() const { return this->RoundingOfPoints; }
  // Left out.
  std::int64_t Repeated() const { return this->NumberOfRepeated; }
  SurfaceAreas Areas() const override { return { this->Shares.data(), this->Area, this->Unit }; }

private:
  void ScalePoints(Progress& progress);
  template <class IsLeftOut>
  void LeaveOut(const IsLeftOut& isLeftOut, Progress& progress);
  void LeaveOutGhosts(vtkPolyData* input, Progress& progress);
  void LeaveOutRepeated(Progress& progress);
  void FindAreas(Progress& progress);
  std::int64_t Given(std::int64_t triangle) const
  {
    return this->Kept.size() > 0 ? this->Kept.data()[triangle] : triangle;
  }

  std::optional<TriangulatedSurface> Cells;
  LargeBuffer<double> Coordinates;
  LargeBuffer<std::int64_t> Corners;
  LargeBuffer<std::int64_t> Kept; // triangles of Cells; empty if these are all
  LargeBuffer<double> Shares;
  std::int64_t NumberOfRepeated = 0;
  double RoundingOfPoints = 0.0;
  double Area = 0.0;
  double Unit = 1.0;
};

} // namespace RectifiedTransport::Bridge

#endif
