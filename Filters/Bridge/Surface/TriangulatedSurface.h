// SPDX-License-Identifier: BSD-3-Clause
// The polygons and strips of a vtkPolyData as triangles, and the cells that they come from.
#ifndef RectifiedTransport_TriangulatedSurface_h
#define RectifiedTransport_TriangulatedSurface_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class SplitSurface;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class TriangulatedSurface
{
public:
  // `input` has polygons or strips, whose points exist. Cuts them into triangles. Throws Failure if
  // there are polygons that cannot be cut, and Cancelled.
  TriangulatedSurface(vtkPolyData* input, Progress& progress);

  // The input itself if all polygons are triangles and there are no strips. Else its points,
  // vertices, lines and triangles, with all point and field data, and the cell data of the cells
  // that they come from, except global ids, which would no longer be unique.
  vtkPolyData* Get() const { return this->Surface; }
  std::int64_t NumberOfTriangles() const;
  // The number of the first polygon: vtkPolyData numbers vertices, lines, polygons, strips.
  vtkIdType FirstCell() const { return this->FirstPolygon; }
  // The cell of Get() that a triangle is.
  vtkIdType CellOf(std::int64_t triangle) const
  {
    return this->FirstPolygon + static_cast<vtkIdType>(triangle);
  }
  // The cell of the input that a triangle was cut from.
  vtkIdType InputCellOf(std::int64_t triangle) const
  {
    return this->InputCells.size() > 0 ? this->InputCells.data()[triangle] : this->CellOf(triangle);
  }
  // Three points a triangle. Throws Cancelled and std::bad_alloc.
  LargeBuffer<std::int64_t> Corners(Progress& progress) const;

  // Replaces the triangles by their parts, which are cells of the same data as above. Throws
  // Failure and Cancelled.
  void Cut(const SplitSurface& parts, Progress& progress);

private:
  vtkSmartPointer<vtkPolyData> WithTriangles(vtkCellArray* triangles) const;
  void FindInputCells(vtkPolyData* input, Progress& progress);
  void CopyCellData(vtkPolyData* input, Progress& progress);

  vtkSmartPointer<vtkPolyData> Surface;
  vtkIdType FirstPolygon;
  LargeBuffer<vtkIdType> InputCells; // of triangles; empty if they are the input's
};

} // namespace RectifiedTransport::Bridge

#endif
