// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/DiskSurface.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"

#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

DiskSurface::DiskSurface(vtkPolyData* input, Progress& progress, double end)
{
  const SurfaceStages stages{ progress, progress.StageEnd(), end };
  stages.Next(0.1);
  const LargeBuffer<double> coordinates = readSurfacePoints(input, "it must be a disk", progress);
  this->Cells.emplace(input, stages, 0.45);
  this->MakeDisk(coordinates, stages);
}

void DiskSurface::MakeDisk(const LargeBuffer<double>& coordinates, const SurfaceStages& stages)
{
  Progress& progress = stages.Run;
  vtkPolyData* surface = this->Triangulated();
  const std::int64_t points = surface->GetNumberOfPoints();
  const std::int64_t triangles = this->Cells->NumberOfTriangles();
  try
  {
    withMemory("the surface's " + std::to_string(points) + " points and " +
        std::to_string(triangles) + " triangles",
      static_cast<double>(points) * 40.0 + static_cast<double>(triangles) * 104.0, [&]() {
        stages.Next(0.5);
        const LargeBuffer<std::int64_t> corners = this->Cells->Corners(progress);
        stages.Next(1.0);
        this->Mesh.emplace(
          TriangleSurface{ { coordinates.data(), points }, corners.data(), triangles },
          roundingOf(surface->GetPoints()), progress.Stage());
      });
  }
  catch (const NotADisk& defect)
  {
    std::string message = std::string("The input surface ") + defect.what();
    const std::int64_t first = defect.First();
    if (defect.Defect() == DiskDefect::TrianglesWithoutArea &&
      this->Cells->InputCellOf(first) != first)
    {
      message += "; triangle " + std::to_string(first) + " is of cell " +
        std::to_string(this->Cells->InputCellOf(first));
    }
    throw NoDiskSurface(message);
  }
}

GivenTriangles DiskSurface::GivenWithArea(Progress& progress) const
{
  const LargeBuffer<std::int64_t> corners = this->Cells->Corners(progress);
  return { *this->Mesh, corners.data() };
}

std::string DiskSurface::RepairWarning() const
{
  return "The input surface was repaired: " + repairText(this->Mesh->Repairs());
}

std::string repairText(const SurfaceRepairs& repairs)
{
  const auto counted = [](std::int64_t count, const char* what, const char* rest) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s") + rest;
  };
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
  return message;
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

std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles, bool isCut)
{
  return std::to_string(collapsed) + " of " + std::to_string(triangles) +
    " triangles have all points on one side of the square and so no area there; subdivide the "
    "surface" +
    (isCut ? "" : ", or give Corners between these points");
}

} // namespace RectifiedTransport
