// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/PolygonInput.h"

#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTriangleFilter.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// vtkDataArray::GetRange caches its result, which is outdated where ids were changed without
// Modified().
void requireIds(vtkCellArray* cells, std::int64_t points)
{
  visitIds(cells, [points](const auto& ids) {
    for (const auto id : ids)
    {
      const auto point = static_cast<std::int64_t>(id);
      if (point < 0 || point >= points)
      {
        throw Failure("A polygon of the input surface has the point " + std::to_string(point) +
          "; there are points 0 to " + std::to_string(points - 1));
      }
    }
  });
}

std::int64_t countTriangles(vtkCellArray* cells)
{
  std::int64_t triangles = 0;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    triangles += trianglesOf(cells, cell);
  }
  return triangles;
}

// Updates a filter of VTK as the work of the current stage: forwards its progress, and aborts it
// where the host cancels.
void runAsStage(vtkAlgorithm* filter, Progress& progress)
{
  const Context stage = progress.Stage();
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(const_cast<Context*>(&stage));
  observer->SetCallback([](vtkObject* caller, unsigned long, void* data, void* fraction) {
    const auto* context = static_cast<const Context*>(data);
    context->Report(*static_cast<double*>(fraction));
    if (context->IsCancelled && context->IsCancelled())
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  // Its errors are detected in its output, and reported as one Failure.
  vtkNew<vtkCallbackCommand> quiet;
  quiet->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  filter->AddObserver(vtkCommand::ErrorEvent, quiet);
  filter->AddObserver(vtkCommand::WarningEvent, quiet);
  filter->Update();
  if (filter->GetAbortExecute())
  {
    throw Cancelled();
  }
}

} // namespace

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
  requireIds(surface->GetPolys(), points);
  requireIds(surface->GetStrips(), points);
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
  // vtkTriangleFilter ends the program where its output cannot grow. The last reallocation holds
  // the old triangles, of an offset and three ids each, and space for twice as many.
  requireMemory(std::to_string(expected) + " triangles of the input surface",
    static_cast<double>(expected) * 3.0 * 4.0 * sizeof(vtkIdType));
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(polygons);
  surface->SetStrips(strips);
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(surface);
  filter->PassVertsOff();
  filter->PassLinesOff();
  runAsStage(filter, progress);
  vtkCellArray* triangles = filter->GetOutput()->GetPolys();
  const std::int64_t missing = expected - triangles->GetNumberOfCells();
  if (missing != 0)
  {
    throw Failure("The input surface has polygons that cannot be cut into triangles: " +
      std::to_string(missing) +
      " triangles are missing; polygons must be simple: edges must not cross, and no corner be "
      "there twice");
  }
  return triangles;
}

} // namespace RectifiedTransport
