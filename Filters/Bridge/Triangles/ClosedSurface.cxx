// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/ClosedSurface.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Triangles/PolygonInput.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/Repair/RepairText.h"
#include "Surfaces/Solid/SolidPolygons.h"

#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

// The bounds of points in polygons: points of no polygon must not enlarge the domain.
std::array<double, 6> polygonBounds(vtkPolyData* surface)
{
  std::array<double, 6> bounds{ 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  std::vector<unsigned char> used(static_cast<std::size_t>(surface->GetNumberOfPoints()), 0);
  const auto points = static_cast<std::int64_t>(used.size());
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    visitIntegers(cells->GetConnectivityArray(), [&used, points](const auto& ids) {
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

ClosedSurface::ClosedSurface(
  vtkPolyData* input, bool mayBeOpen, const std::string& advice, Progress& progress)
{
  const auto points = static_cast<double>(input->GetNumberOfPoints());
  constexpr double bytesOfPoint = 64.0; // with the table
  Stages stages(progress, { { "points", 10 }, { "table", 15 }, { "polygons", 75 } });
  LargeBuffer<double> coordinates =
    readSurfacePoints(input, "a solid needs a closed surface", stages["points"], bytesOfPoint);
  this->Box = polygonBounds(input);
  const ClosingDistances distances(this->Box, input->GetPoints()->GetDataType() == VTK_FLOAT);
  const PolygonSource polygons = polygonsOf(input);
  const auto add = [&](ClosedMesh& mesh, Progress& part) {
    if (!isAllTriangles(input))
    {
      addPolygons(polygons, mesh, part);
      return;
    }
    mesh.Reserve(polygons.NumberOfTriangles);
    visitTriangles(input->GetPolys(), part,
      [&](std::int64_t, const std::array<std::int64_t, 3>& corners) { mesh.Add(corners); });
  };
  withMemory(
    { "the table of the surface's " + std::to_string(input->GetNumberOfPoints()) + " points",
      points * 4.0 * sizeof(std::int64_t) },
    [&]() { this->Mesh.emplace(std::move(coordinates), stages["table"]); });
  const std::int64_t triangles = polygons.NumberOfTriangles;
  const std::string problem =
    withMemory({ "the edges of the surface's " + std::to_string(triangles) + " triangles",
                 static_cast<double>(triangles) * 110.0 },
      [&]() { return this->Mesh->Close(add, distances, stages["polygons"]); });
  this->StaysOpen =
    !problem.empty() && this->Mesh->OpenEdges() + this->Mesh->NonManifoldEdges() > 0;
  if (!problem.empty() && !(this->StaysOpen && mayBeOpen))
  {
    throw Failure((this->StaysOpen ? advice : "") + "The input surface " + problem);
  }
}

std::string ClosedSurface::RepairWarning() const
{
  RepairCounts counts;
  counts.TJunctions = this->Mesh->TJunctions();
  counts.Gap = this->Mesh->HadGaps() ? this->Mesh->WidestGap() : 0.0;
  return repairWarning(counts);
}

// Signed volumes need consistent orientation: two triangles at an edge must run along it in
// opposite directions, for which one side of the surface has to be the inside.
SolidSurface ClosedSurface::InCells(const ImageGrid& grid, Progress& progress)
{
  Stages stages(progress, { { "points", 1 }, { "orientation", 1 } });
  this->Mesh->MoveToCells(grid, this->Box, stages["points"]);
  const std::int64_t triangles = this->Mesh->Surface().NumberOfTriangles;
  if (this->StaysOpen)
  {
    this->Mesh->OrientOpen(stages["orientation"]);
    return this->Mesh->Surface();
  }
  const bool oriented =
    withMemory({ "the orientation of the surface's triangles",
                 static_cast<double>(triangles) * (2 * sizeof(std::int64_t) + 1) },
      [&]() { return this->Mesh->Orient(stages["orientation"]); });
  if (!oriented)
  {
    throw Failure("The input surface is not orientable: it has one side only, as a Klein bottle; "
                  "a solid needs a surface with an inside");
  }
  return this->Mesh->Solid();
}

} // namespace RectifiedTransport::Bridge
