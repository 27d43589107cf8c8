// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Solid/ClosedSurface.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/LargeBuffer.h"

#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

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
    RandomAccessUnits);
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
    stage(0.1);
    coordinates = readPoints(input, progress);
  });
  requirePolygons(input, "a solid needs a closed surface");
  stage(0.25);
  withMemory("the table of the surface's " + points,
    static_cast<double>(this->NumberOfPoints) * 4.0 * sizeof(std::int64_t),
    [&]() { this->Mesh.emplace(std::move(coordinates), progress.Stage()); });
  vtkSmartPointer<vtkCellArray> triangles = input->GetPolys();
  if (!isAllTriangles(input))
  {
    stage(0.3);
    triangles = mergeCorners(triangles, *this->Mesh, progress);
    stage(0.4);
    triangles = triangulate(input->GetPoints(), triangles, input->GetStrips(), progress);
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
  this->Mesh->Reserve(triangles->GetNumberOfCells());
  visitTriangles(triangles, progress,
    [this](std::int64_t, const std::array<std::int64_t, 3>& points) { this->Mesh->Add(points); });
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
