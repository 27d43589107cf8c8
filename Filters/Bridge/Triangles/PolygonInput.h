// SPDX-License-Identifier: BSD-3-Clause
// The points, polygons and strips of a vtkPolyData.
#ifndef RectifiedTransport_PolygonInput_h
#define RectifiedTransport_PolygonInput_h

#include "Bridge/Data/IntegerArrays.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/CutPolygons.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace RectifiedTransport::Bridge
{

// Units of a slice of work with random memory access, for Progress.
constexpr std::int64_t RandomAccessUnits = std::int64_t{ 1 } << 16;

// The coordinates of the points of a surface that has polygons, three each. Throws Failure if they
// are not finite, without memory for them, and if there are neither polygons nor strips, or these
// use points that do not exist; `need` completes "N points and no polygons; ". Throws Cancelled.
LargeBuffer<double> readSurfacePoints(
  vtkPolyData* surface, const std::string& need, Progress& progress, double bytesOfPoint = 24.0);

// Whether all polygons are triangles, and there are no strips.
bool isAllTriangles(vtkPolyData* surface);

// Its polygons and strips, cell by cell, and vtkPolygon's way to cut. The surface must outlive it.
PolygonSource polygonsOf(vtkPolyData* surface);

// Calls visit(i, points) for every triangle i in order. All cells must be triangles. Throws
// Cancelled.
template <class Visit>
void visitTriangles(vtkCellArray* triangles, Progress& progress, const Visit& visit)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  visitIntegers(triangles->GetConnectivityArray(), [&](const auto& ids) {
    progress.ForEachInOrder(
      triangles->GetNumberOfCells(), grain,
      [&](std::int64_t triangle) {
        std::array<std::int64_t, 3> points;
        for (std::size_t corner = 0; corner < 3; ++corner)
        {
          points[corner] =
            static_cast<std::int64_t>(ids[3 * triangle + static_cast<std::int64_t>(corner)]);
        }
        visit(triangle, points);
      },
      RandomAccessUnits);
  });
}

} // namespace RectifiedTransport::Bridge

#endif
