// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/PolygonInput.h"

#include "Bridge/Points/CellCheck.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonCutter.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport::Bridge
{

namespace
{

std::int64_t countTriangles(vtkCellArray* cells)
{
  std::int64_t triangles = 0;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    triangles += trianglesOf(cells, cell);
  }
  return triangles;
}

// Appends the triangles of a strip, all with its orientation.
void cutStrip(vtkIdType count, const vtkIdType* points, vtkCellArray* triangles)
{
  for (vtkIdType i = 2; i < count; ++i)
  {
    const bool isOdd = i % 2 == 1;
    const vtkIdType ids[3] = { points[isOdd ? i - 1 : i - 2], points[isOdd ? i - 2 : i - 1],
      points[i] };
    triangles->InsertNextCell(3, ids);
  }
}

// Appends the triangles of polygons and strips, one by one: from VTK 9.6 on vtkTriangleFilter cuts
// quadrilaterals whose edges cross without a word. Returns how many triangles are missing, and
// `firstMissing` is the first polygon that misses some.
std::int64_t cutEach(vtkPoints* points, vtkCellArray* polygons, vtkCellArray* strips,
  Progress& progress, vtkCellArray* triangles, std::int64_t& firstMissing)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 8;
  constexpr std::int64_t units = std::int64_t{ 1 } << 12; // of polygons, some milliseconds
  PolygonCutter cutter(points, roundingOf(points));
  std::int64_t missing = 0;
  vtkNew<vtkIdList> ids;
  for (vtkCellArray* cells : { polygons, strips })
  {
    progress.ForInOrder(
      cells->GetNumberOfCells(), grain,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t cell = first; cell < last; ++cell)
        {
          cells->GetCellAtId(static_cast<vtkIdType>(cell), ids);
          if (cells == strips)
          {
            cutStrip(ids->GetNumberOfIds(), ids->GetPointer(0), triangles);
          }
          else if (!cutter.Cut(ids->GetNumberOfIds(), ids->GetPointer(0), triangles))
          {
            firstMissing = missing == 0 ? cell : firstMissing;
            missing += ids->GetNumberOfIds() - 2;
          }
        }
      },
      units);
  }
  return missing;
}

} // namespace

double roundingOf(vtkPoints* points)
{
  double farthest = 0.0;
  bool areFloats = true;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    for (const double coordinate : x)
    {
      farthest = std::max(farthest, std::abs(coordinate));
      areFloats = areFloats && std::abs(coordinate) <= std::numeric_limits<float>::max() &&
        static_cast<double>(static_cast<float>(coordinate)) == coordinate;
    }
  }
  constexpr double units = 4.0;
  return units * farthest *
    (areFloats ? static_cast<double>(std::numeric_limits<float>::epsilon())
               : std::numeric_limits<double>::epsilon());
}

LargeBuffer<double> readPoints(vtkPolyData* surface, Progress& progress)
{
  LargeBuffer<double> coordinates(3 * surface->GetNumberOfPoints());
  double* copy = coordinates.data();
  visitPoints(surface, "input surface", progress,
    [copy](std::int64_t i, const double* x) { std::copy_n(x, 3, copy + 3 * i); });
  return coordinates;
}

void requirePolygons(vtkPolyData* surface, const std::string& need)
{
  const std::int64_t points = surface->GetNumberOfPoints();
  if (surface->GetNumberOfPolys() + surface->GetNumberOfStrips() == 0)
  {
    throw Failure("The input surface has " + std::to_string(points) + " points and no polygons; " +
      need + " of polygons (lines and vertices do not count)");
  }
  requireReadableCells(surface, "input surface");
}

LargeBuffer<double> readSurfacePoints(
  vtkPolyData* surface, const std::string& need, Progress& progress, double bytesOfPoint)
{
  const std::int64_t points = surface->GetNumberOfPoints();
  LargeBuffer<double> coordinates =
    withMemory("the surface's " + std::to_string(points) + " points",
      static_cast<double>(points) * bytesOfPoint, [&]() { return readPoints(surface, progress); });
  requirePolygons(surface, need);
  return coordinates;
}

bool isAllTriangles(vtkPolyData* surface)
{
  return surface->GetNumberOfStrips() == 0 && surface->GetPolys()->IsHomogeneous() == 3;
}

std::int64_t trianglesOf(vtkCellArray* cells, vtkIdType cell)
{
  return std::max<std::int64_t>(0, cells->GetCellSize(cell) - 2);
}

vtkSmartPointer<vtkCellArray> triangulate(
  vtkPoints* points, vtkCellArray* polygons, vtkCellArray* strips, Progress& progress)
{
  const std::int64_t expected = countTriangles(polygons) + countTriangles(strips);
  requireMemory(std::to_string(expected) + " triangles of the input surface",
    static_cast<double>(expected) * 4.0 * sizeof(vtkIdType));
  auto triangles = vtkSmartPointer<vtkCellArray>::New();
  triangles->AllocateExact(static_cast<vtkIdType>(expected), static_cast<vtkIdType>(3 * expected));
  std::int64_t first = 0;
  const std::int64_t missing = cutEach(points, polygons, strips, progress, triangles, first);
  if (missing != 0)
  {
    throw Failure("The input surface has polygons that cannot be cut into triangles: " +
      std::to_string(missing) + " triangles are missing (the first of polygon " +
      std::to_string(first) +
      ", counted from 0); polygons must be simple: edges must not cross, and no corner be "
      "there twice");
  }
  return triangles;
}

} // namespace RectifiedTransport::Bridge
