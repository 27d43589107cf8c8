// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Solid/ClosedSurface.h"

#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/LargeBuffer.h"

#include "vtkArrayDispatch.h"
#include "vtkBoundingBox.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataArrayRange.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;
// Units of a slice of work with random memory access.
constexpr std::int64_t Slow = std::int64_t{ 1 } << 16;

// The number of triangles of polygons or strips: one for each point of a vtkCell beyond the second.
std::int64_t countTriangles(vtkCellArray* cells)
{
  std::int64_t triangles = 0;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    triangles += std::max<std::int64_t>(0, cells->GetCellSize(cell) - 2);
  }
  return triangles;
}

// Calls visit(ids) with the values of the connectivity array, in its value type.
template <class Visit>
void visitIds(vtkCellArray* cells, const Visit& visit)
{
  using Integers = vtkTypeList::Create<int, long, long long>; // that cell arrays store
  using Dispatch = vtkArrayDispatch::DispatchByValueType<Integers>;
  const auto call = [&visit](auto* array) { visit(vtk::DataArrayValueRange<1>(array)); };
  vtkDataArray* ids = cells->GetConnectivityArray();
  if (!Dispatch::Execute(ids, call))
  {
    call(ids);
  }
}

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

// Polygons and strips as triangles, in the order of the polygons.
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

// The polygons without consecutive corners of equal coordinates, as at the poles of a sphere of
// quads; those of fewer than three remaining corners are dropped.
vtkSmartPointer<vtkCellArray> mergeCorners(
  vtkCellArray* polygons, const ClosedMesh& mesh, Progress& progress)
{
  const vtkIdType cells = polygons->GetNumberOfCells();
  const vtkIdType ids = polygons->GetNumberOfConnectivityIds();
  requireMemory("the " + std::to_string(cells) + " polygons of the input surface",
    static_cast<double>(cells + 1 + ids) * sizeof(vtkIdType));
  auto merged = vtkSmartPointer<vtkCellArray>::New();
  merged->AllocateExact(cells, ids);
  vtkNew<vtkIdList> corners;
  progress.ForInOrder(
    cells, Grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t polygon = first; polygon < last; ++polygon)
      {
        polygons->GetCellAtId(polygon, corners);
        vtkIdType kept = 0;
        for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
        {
          const vtkIdType corner = mesh.FirstOf(corners->GetId(i));
          if (kept == 0 || corner != corners->GetId(kept - 1))
          {
            corners->SetId(kept++, corner);
          }
        }
        while (kept > 1 && corners->GetId(0) == corners->GetId(kept - 1))
        {
          --kept;
        }
        if (kept >= 3)
        {
          merged->InsertNextCell(kept, corners->GetPointer(0));
        }
      }
    },
    Slow);
  return merged;
}

} // namespace

std::array<double, 6> polygonBounds(vtkPolyData* surface)
{
  std::array<double, 6> bounds{ 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  std::vector<unsigned char> used(static_cast<std::size_t>(surface->GetNumberOfPoints()), 0);
  const auto points = static_cast<std::int64_t>(used.size());
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    visitIds(cells, [&used, points](const auto& ids) {
      for (const auto id : ids)
      {
        const auto point = static_cast<std::int64_t>(id);
        if (point >= 0 && point < points) // an error in RequestData
        {
          used[static_cast<std::size_t>(point)] = 1;
        }
      }
    });
  }
  if (std::find(used.begin(), used.end(), 1) != used.end())
  {
    vtkBoundingBox::ComputeBounds(surface->GetPoints(), used.data(), bounds.data());
  }
  return bounds;
}

ClosedSurface::ClosedSurface(vtkPolyData* input, Progress& progress, double end)
  : NumberOfPoints(input->GetNumberOfPoints())
{
  const std::string points = std::to_string(this->NumberOfPoints) + " points";
  const double begin = progress.StageEnd();
  const auto stage = [&progress, begin, end](
                       double part) { progress.BeginStage(begin + part * (end - begin)); };
  LargeBuffer<double> coordinates;
  withMemory("the surface's " + points, static_cast<double>(this->NumberOfPoints) * 64.0, [&]() {
    coordinates = LargeBuffer<double>(3 * this->NumberOfPoints);
    double* copy = coordinates.data();
    stage(0.1);
    visitPoints(input, "input surface", progress,
      [copy](std::int64_t i, const double* x) { std::copy_n(x, 3, copy + 3 * i); });
  });
  if (input->GetNumberOfPolys() + input->GetNumberOfStrips() == 0)
  {
    throw Failure("The input surface has " + points +
      " and no polygons; a solid needs a closed surface of polygons (lines and vertices do not "
      "count)");
  }
  vtkCellArray* polygons = input->GetPolys();
  vtkCellArray* strips = input->GetStrips();
  requireIds(polygons, this->NumberOfPoints);
  requireIds(strips, this->NumberOfPoints);
  stage(0.25);
  withMemory("the table of the surface's " + points,
    static_cast<double>(this->NumberOfPoints) * 4.0 * sizeof(std::int64_t),
    [&]() { this->Mesh.emplace(std::move(coordinates), progress.Stage()); });
  vtkSmartPointer<vtkCellArray> triangles = polygons;
  if (strips->GetNumberOfCells() > 0 || polygons->IsHomogeneous() != 3)
  {
    stage(0.3);
    triangles = mergeCorners(polygons, *this->Mesh, progress);
    stage(0.4);
    triangles = triangulate(input->GetPoints(), triangles, strips, progress);
  }
  withMemory("the surface's " + std::to_string(triangles->GetNumberOfCells()) + " triangles",
    static_cast<double>(triangles->GetNumberOfCells()) * 9.0 * sizeof(std::int64_t), [&]() {
      stage(0.6);
      this->ReadTriangles(triangles, progress);
      stage(1.0);
      this->Mesh->CountEdges(progress.Stage());
    });
  this->RequireClosed();
}

void ClosedSurface::ReadTriangles(vtkCellArray* triangles, Progress& progress)
{
  const std::int64_t count = triangles->GetNumberOfCells();
  this->Mesh->Reserve(count);
  visitIds(triangles, [&](const auto& ids) {
    progress.ForInOrder(
      count, Grain,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t side = 3 * first; side < 3 * last; side += 3)
        {
          this->Mesh->Add({ static_cast<std::int64_t>(ids[side]),
            static_cast<std::int64_t>(ids[side + 1]), static_cast<std::int64_t>(ids[side + 2]) });
        }
      },
      Slow);
  });
  if (this->Mesh->Surface().NumberOfTriangles == 0)
  {
    throw Failure("The input surface has " + std::to_string(this->NumberOfPoints) +
      " points and no polygon of three different ones; a solid needs a closed surface");
  }
}

void ClosedSurface::RequireClosed() const
{
  if (!this->Mesh->IsClosed())
  {
    const std::int64_t open = this->Mesh->OpenEdges();
    const std::int64_t nonManifold = this->Mesh->NonManifoldEdges();
    std::ostringstream message;
    message << "The input surface is not closed: it has " << open
            << (open == 1 ? " open edge" : " open edges") << " and " << nonManifold
            << (nonManifold == 1 ? " non-manifold edge" : " non-manifold edges")
            << "; every edge must be one of exactly two triangles";
    throw Failure(message.str());
  }
}

TriangleSurface ClosedSurface::InCells(const ImageGrid& grid, Progress& progress, double end)
{
  double* points = this->Mesh->Points().data();
  const double spacing = grid.Spacing()[0];
  const Eigen::Vector3d corner = grid.Origin();
  progress.BeginStage(0.5 * (progress.StageEnd() + end));
  progress.For(this->NumberOfPoints, Grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        points[3 * i + static_cast<std::int64_t>(a)] =
          (points[3 * i + static_cast<std::int64_t>(a)] - corner[static_cast<Eigen::Index>(a)]) /
          spacing;
      }
    }
  });
  progress.BeginStage(end);
  const std::int64_t triangles = this->Mesh->Surface().NumberOfTriangles;
  const bool oriented = withMemory("the orientation of the surface's triangles",
    static_cast<double>(triangles) * (sizeof(std::int64_t) + 1),
    [&]() { return this->Mesh->Orient(progress.Stage()); });
  if (!oriented)
  {
    throw Failure("The input surface is not orientable: it has one side only, as a Klein bottle; "
                  "a solid needs a surface with an inside");
  }
  return this->Mesh->Surface();
}

} // namespace RectifiedTransport
