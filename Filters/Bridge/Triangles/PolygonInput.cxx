// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/PolygonInput.h"

#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Run/Memory.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolygon.h"
#include "vtkSmartPointer.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

std::int64_t countTriangles(vtkPolyData* surface)
{
  std::int64_t triangles = 0;
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      triangles += std::max<std::int64_t>(0, cells->GetCellSize(cell) - 2);
    }
  }
  return triangles;
}

// The way of vtkPolygon.
RingCutter makeRingCutter()
{
  auto polygon = vtkSmartPointer<vtkPolygon>::New();
  polygon->Points->SetDataTypeToDouble();
  auto places = vtkSmartPointer<vtkIdList>::New(); // three corners a triangle
  auto ignored = vtkSmartPointer<vtkPoints>::New();
  return [=](const std::vector<Point<3>>& ring, std::vector<std::size_t>& triangles) {
    places->Reset();
    const auto count = static_cast<vtkIdType>(ring.size());
    polygon->PointIds->SetNumberOfIds(count);
    polygon->Points->SetNumberOfPoints(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      polygon->PointIds->SetId(i, i);
      polygon->Points->SetPoint(i, ring[static_cast<std::size_t>(i)].data());
    }
    const bool isCut = polygon->Triangulate(0, places, ignored) != 0;
    std::for_each(places->begin(), places->end(),
      [&](vtkIdType place) { triangles.push_back(static_cast<std::size_t>(place)); });
    return isCut;
  };
}

PolygonSource::Visits visitsOf(vtkCellArray* cells)
{
  return [cells](Progress& progress, const PolygonSource::Visit& visit) {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 8;
    constexpr std::int64_t units = std::int64_t{ 1 } << 12; // polygons that take some milliseconds
    vtkNew<vtkIdList> ids;
    PolygonCutter::Corners corners;
    progress.ForEachInOrder(
      cells->GetNumberOfCells(), grain,
      [&](std::int64_t cell) {
        cells->GetCellAtId(static_cast<vtkIdType>(cell), ids);
        corners.assign(ids->begin(), ids->end());
        visit(cell, corners);
      },
      units);
  };
}

} // namespace

LargeBuffer<double> readSurfacePoints(
  vtkPolyData* surface, const std::string& need, Progress& progress, double bytesOfPoint)
{
  const std::int64_t points = surface->GetNumberOfPoints();
  LargeBuffer<double> coordinates = withMemory(
    { "the surface's " + std::to_string(points) + " points",
      static_cast<double>(points) * bytesOfPoint },
    [&]() {
      LargeBuffer<double> read(3 * points);
      visitPoints(surface, "input surface", progress,
        [copy = read.data()](std::int64_t i, const double* x) { std::copy_n(x, 3, copy + 3 * i); });
      return read;
    });
  if (surface->GetNumberOfPolys() + surface->GetNumberOfStrips() == 0)
  {
    throw Failure("The input surface has " + std::to_string(points) + " points and no polygons; " +
      need + " of polygons (lines and vertices do not count)");
  }
  requireReadableCells(surface, "input surface");
  return coordinates;
}

bool isAllTriangles(vtkPolyData* surface)
{
  return surface->GetNumberOfStrips() == 0 && surface->GetPolys()->IsHomogeneous() == 3;
}

PolygonSource polygonsOf(vtkPolyData* surface)
{
  return { visitsOf(surface->GetPolys()), visitsOf(surface->GetStrips()),
    surface->GetNumberOfPolys(), surface->GetNumberOfStrips(), countTriangles(surface),
    makeRingCutter() };
}

} // namespace RectifiedTransport::Bridge
