// SPDX-License-Identifier: BSD-3-Clause
// The polygons and strips of a vtkPolyData as triangles.
#ifndef RectifiedTransport_PolygonInput_h
#define RectifiedTransport_PolygonInput_h

#include "Bridge/Points/IntegerArrays.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellArray.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkPoints;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Units of a slice of work with random memory access, for Progress.
constexpr std::int64_t RandomAccessUnits = std::int64_t{ 1 } << 16;

// The coordinates of all points, three each. Throws Failure if they are not finite, Cancelled and
// std::bad_alloc.
LargeBuffer<double> readPoints(vtkPolyData* surface, Progress& progress);

// By how much the coordinates of one position may differ by rounding. It is that of float if all of
// them are floats, even if the points are double.
double roundingOf(vtkPoints* points);

// Throws Failure if a surface has neither polygons nor strips, or these use points that do not
// exist; `need` completes "N points and no polygons; ".
void requirePolygons(vtkPolyData* surface, const std::string& need);

// Both: the coordinates of a surface that has polygons. Throws Failure, also without memory for
// them, and Cancelled.
LargeBuffer<double> readSurfacePoints(
  vtkPolyData* surface, const std::string& need, Progress& progress, double bytesOfPoint = 24.0);

// Whether all polygons are triangles, and there are no strips.
bool isAllTriangles(vtkPolyData* surface);

// The number of triangles of a polygon or strip: one for each point beyond the second.
std::int64_t trianglesOf(vtkCellArray* cells, vtkIdType cell);

// Polygons and strips as triangles, in their order, as many as trianglesOf() counts. Coincident or
// collinear corners of polygons give triangles without area. Throws Failure if edges of a polygon
// cross, and Cancelled.
vtkSmartPointer<vtkCellArray> triangulate(
  vtkPoints* points, vtkCellArray* polygons, vtkCellArray* strips, Progress& progress);

// Calls visit(i, points) for every triangle i in order. All cells must be triangles. Throws
// Cancelled.
template <class Visit>
void visitTriangles(vtkCellArray* triangles, Progress& progress, const Visit& visit)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  const std::int64_t count = triangles->GetNumberOfCells();
  visitIntegers(triangles->GetConnectivityArray(), [&](const auto& ids) {
    progress.ForInOrder(
      count, grain,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t triangle = first; triangle < last; ++triangle)
        {
          std::array<std::int64_t, 3> points;
          for (std::size_t corner = 0; corner < 3; ++corner)
          {
            points[corner] =
              static_cast<std::int64_t>(ids[3 * triangle + static_cast<std::int64_t>(corner)]);
          }
          visit(triangle, points);
        }
      },
      RandomAccessUnits);
  });
}

} // namespace RectifiedTransport::Bridge

#endif
