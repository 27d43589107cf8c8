// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/DiskSurface.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/RepairText.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace RectifiedTransport::Bridge
{

DiskSurface::DiskSurface(SurfaceTriangles& input, Progress& progress)
{
  this->Make(input, progress);
}

DiskSurface::DiskSurface(vtkPolyData* input, Progress& progress)
{
  Stages stages(progress, { { "triangles", 45 }, { "disk", 55 } });
  SurfaceTriangles read(input, "it must be a disk", stages["triangles"]);
  this->Make(read, stages["disk"]);
}

void DiskSurface::Make(SurfaceTriangles& input, Progress& progress)
{
  Stages stages(progress, { { "disk", 5 }, { "T-junctions", 2 }, { "repaired disk", 3 } });
  std::optional<NoDiskSurface> defect;
  try
  {
    this->MakeDisk(input, stages["disk"]);
  }
  catch (const NoDiskSurface& found)
  {
    defect = found;
  }
  // A cut that makes the surface a disk stays open.
  const TJunctionScope scope = defect ? TJunctionScope::All : TJunctionScope::OfFlatTriangles;
  const bool isCut = (defect || this->Mesh->Repairs().FlatTriangles > 0) &&
    input.CloseTJunctions(scope, stages["T-junctions"]);
  if (defect && !isCut)
  {
    throw NoDiskSurface(*defect);
  }
  if (isCut)
  {
    try
    {
      this->MakeDisk(input, stages["repaired disk"]);
    }
    catch (const NoDiskSurface& found)
    {
      // Parts without area are more than the triangles that the user has.
      throw defect && defect->HasNoArea && found.HasNoArea ? *defect : found;
    }
  }
  this->Input = std::move(input);
  this->Input->Free();
  progress.EndSlice(1);
}

void DiskSurface::MakeDisk(const SurfaceTriangles& input, Progress& progress)
{
  const TriangleSurface surface = input.Surface();
  try
  {
    withMemory("the surface's " + std::to_string(surface.Points.size()) + " points and " +
        std::to_string(surface.NumberOfTriangles) + " triangles",
      static_cast<double>(surface.Points.size()) * 40.0 +
        static_cast<double>(surface.NumberOfTriangles) * 80.0,
      [&]() { this->Mesh.emplace(surface, input.Rounding(), progress); });
  }
  catch (const NotADisk& defect)
  {
    std::string message = std::string("The input surface ") + defect.what();
    const std::int64_t first = defect.First();
    if (defect.Defect() == DiskDefect::TrianglesWithoutArea &&
      input.Cells().InputCellOf(first) != first)
    {
      message += "; triangle " + std::to_string(first) + " is of cell " +
        std::to_string(input.Cells().InputCellOf(first));
    }
    throw NoDiskSurface(message, defect.Defect());
  }
}

GivenTriangles DiskSurface::GivenWithArea(Progress& progress) const
{
  const LargeBuffer<std::int64_t> corners = this->Cells().Corners(progress);
  return { *this->Mesh, corners.data() };
}

bool DiskSurface::IsPart(std::int64_t triangle) const
{
  const std::optional<SplitSurface>& parts = this->Input->Parts();
  return parts && parts->IsPart(this->Mesh->GivenTriangle(triangle));
}

PointWeights DiskSurface::InCell(const PlaceOnTriangle& place) const
{
  PointWeights found{ this->CornersOf(place.Triangle), place.Weights };
  if (!this->IsPart(place.Triangle))
  {
    return found;
  }
  // The corners of the part, perhaps in another order.
  const SplitSurface& parts = *this->Input->Parts();
  PlaceOnTriangle onPart{ this->Mesh->GivenTriangle(place.Triangle), { 0.0, 0.0, 0.0 } };
  const std::int64_t* corners = parts.Triangles() + 3 * onPart.Triangle;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::int64_t* corner = std::find(corners, corners + 3, found.Points[i]);
    if (corner == corners + 3)
    {
      return found; // without area, the part was cut at a point of another one
    }
    onPart.Weights[static_cast<std::size_t>(corner - corners)] = place.Weights[i];
  }
  return { parts.GivenCorners(onPart.Triangle), parts.GivenPlace(onPart).Weights };
}

std::string DiskSurface::RepairWarning() const
{
  const SurfaceRepairs repairs = this->Mesh->Repairs();
  RepairCounts counts;
  counts.UnusedPoints = repairs.UnusedPoints;
  counts.FlatTriangles = repairs.FlatTriangles + this->Input->FlatTriangles();
  counts.MergedPoints = repairs.MergedPoints;
  counts.Repeated = repairs.Repeated;
  counts.TJunctions = this->Input->TJunctions();
  return repairWarning(counts);
}

ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress)
{
  constexpr double bytesOfPoint = 1350.0;
  const std::int64_t points = disk.NumberOfPoints();
  try
  {
    return withMemory("the conformal map of " + std::to_string(points) + " points",
      bytesOfPoint * static_cast<double>(points),
      [&]() { return mapConformally(disk, corners, progress); });
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

} // namespace RectifiedTransport::Bridge
