// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/DiskSurface.h"

#include "Bridge/Points/CopiedTuples.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

LargeBuffer<std::int64_t> readTriangles(vtkCellArray* cells, Progress& progress)
{
  LargeBuffer<std::int64_t> corners(3 * cells->GetNumberOfCells());
  std::int64_t* copy = corners.data();
  visitTriangles(
    cells, progress, [copy](std::int64_t triangle, const std::array<std::int64_t, 3>& ids) {
      std::copy_n(ids.data(), 3, copy + 3 * triangle);
    });
  return corners;
}

} // namespace

DiskSurface::DiskSurface(vtkPolyData* input, Progress& progress, double end)
  : Surface(input)
  , FirstPolygon(input->GetNumberOfVerts() + input->GetNumberOfLines())
{
  const Stages stages{ progress, progress.StageEnd(), end };
  const std::int64_t points = input->GetNumberOfPoints();
  stages.Next(0.1);
  const LargeBuffer<double> coordinates =
    withMemory("the surface's " + std::to_string(points) + " points",
      static_cast<double>(points) * 24.0, [&]() { return readPoints(input, progress); });
  requirePolygons(input, "it must be a disk");
  if (!isAllTriangles(input))
  {
    this->Triangulate(input, stages);
  }
  this->MakeDisk(coordinates, stages);
}

void DiskSurface::Triangulate(vtkPolyData* input, const Stages& stages)
{
  Progress& progress = stages.Run;
  stages.Next(0.3);
  const vtkSmartPointer<vtkCellArray> triangles =
    triangulate(input->GetPoints(), input->GetPolys(), input->GetStrips(), progress);
  this->Surface = vtkSmartPointer<vtkPolyData>::New();
  this->Surface->SetPoints(input->GetPoints());
  this->Surface->SetVerts(input->GetVerts());
  this->Surface->SetLines(input->GetLines());
  this->Surface->SetPolys(triangles);
  this->Surface->GetPointData()->PassData(input->GetPointData());
  this->Surface->GetFieldData()->PassData(input->GetFieldData());
  stages.Next(0.35);
  const auto count = static_cast<std::int64_t>(triangles->GetNumberOfCells());
  withMemory("the cells of the surface's " + std::to_string(count) + " triangles",
    static_cast<double>(count) * sizeof(vtkIdType), [&]() {
      this->InputCells = LargeBuffer<vtkIdType>(count);
      this->FindInputCells(input, progress);
    });
  stages.Next(0.45);
  this->CopyCellData(input, progress);
}

// triangulate() returns all triangles, in the order of the polygons and then the strips.
void DiskSurface::FindInputCells(vtkPolyData* input, Progress& progress)
{
  vtkIdType* next = this->InputCells.data();
  vtkIdType before = this->FirstPolygon;
  for (vtkCellArray* cells : { input->GetPolys(), input->GetStrips() })
  {
    progress.ForInOrder(
      cells->GetNumberOfCells(), Grain,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t cell = first; cell < last; ++cell)
        {
          next = std::fill_n(next, trianglesOf(cells, cell), before + static_cast<vtkIdType>(cell));
        }
      },
      RandomAccessUnits);
    before += cells->GetNumberOfCells();
  }
}

void DiskSurface::CopyCellData(vtkPolyData* input, Progress& progress)
{
  copyTuples(
    { input->GetCellData(), input->GetNumberOfCells(), "cell", "input surface" },
    this->Surface->GetNumberOfCells(),
    [this](vtkIdType cell) {
      return cell < this->FirstPolygon ? cell : this->InputCells.data()[cell - this->FirstPolygon];
    },
    this->Surface->GetCellData(), progress);
}

void DiskSurface::MakeDisk(const LargeBuffer<double>& coordinates, const Stages& stages)
{
  Progress& progress = stages.Run;
  const std::int64_t points = this->Surface->GetNumberOfPoints();
  vtkCellArray* cells = this->Surface->GetPolys();
  const std::int64_t triangles = cells->GetNumberOfCells();
  try
  {
    withMemory("the surface's " + std::to_string(points) + " points and " +
        std::to_string(triangles) + " triangles",
      static_cast<double>(points) * 40.0 + static_cast<double>(triangles) * 104.0, [&]() {
        stages.Next(0.5);
        const LargeBuffer<std::int64_t> corners = readTriangles(cells, progress);
        stages.Next(1.0);
        this->Mesh.emplace(
          TriangleSurface{ { coordinates.data(), points }, corners.data(), triangles },
          roundingOf(this->Surface->GetPoints()), progress.Stage());
      });
  }
  catch (const NotADisk& defect)
  {
    std::string message = std::string("The input surface ") + defect.what();
    const std::int64_t first = defect.First();
    if (defect.Defect() == DiskDefect::TrianglesWithoutArea && this->InputCell(first) != first)
    {
      message += "; triangle " + std::to_string(first) + " is of cell " +
        std::to_string(this->InputCell(first));
    }
    throw Failure(message);
  }
}

GivenTriangles DiskSurface::GivenWithArea(Progress& progress) const
{
  const LargeBuffer<std::int64_t> corners = readTriangles(this->Surface->GetPolys(), progress);
  return { *this->Mesh, corners.data() };
}

std::string DiskSurface::RepairWarning() const
{
  const auto counted = [](std::int64_t count, const char* what, const char* rest) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s") + rest;
  };
  const SurfaceRepairs repairs = this->Mesh->Repairs();
  std::string message;
  const auto add = [&message](
                     const std::string& part) { message += (message.empty() ? "" : ", ") + part; };
  if (repairs.UnusedPoints > 0)
  {
    add(counted(repairs.UnusedPoints, "point", " in no polygon left out"));
  }
  if (repairs.FlatTriangles > 0)
  {
    add(counted(repairs.FlatTriangles, "triangle", " without area left out"));
  }
  if (repairs.MergedPoints > 0)
  {
    add(counted(repairs.MergedPoints, "point", " merged with others at their places"));
  }
  return "The input surface was repaired: " + message;
}

ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress)
{
  constexpr double bytesOfPoint = 1350.0;
  const std::int64_t points = disk.NumberOfPoints();
  try
  {
    return withMemory("the conformal map of " + std::to_string(points) + " points",
      bytesOfPoint * static_cast<double>(points),
      [&]() { return mapConformally(disk, corners, progress.Stage()); });
  }
  catch (const std::invalid_argument& error)
  {
    throw Failure(std::string("The input surface ") + error.what());
  }
}

std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles)
{
  return std::to_string(collapsed) + " of " + std::to_string(triangles) +
    " triangles have all points on one side of the square and so no area there; subdivide the "
    "surface, or give Corners between these points";
}

} // namespace RectifiedTransport
