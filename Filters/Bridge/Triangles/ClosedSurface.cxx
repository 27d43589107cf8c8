// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/ClosedSurface.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Triangles/PolygonInput.h"
#include "Core/Mesh/Repair/RepairText.h"
#include "Core/Mesh/Repair/TJunctions.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

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

ClosedSurface::ClosedSurface(vtkPolyData* input, Progress& progress)
{
  const auto points = static_cast<double>(input->GetNumberOfPoints());
  constexpr double bytesOfPoint = 64.0; // with the table
  Stages stages(progress, { { "points", 10 }, { "table", 15 }, { "polygons", 75 } });
  LargeBuffer<double> coordinates =
    readSurfacePoints(input, "a solid needs a closed surface", stages["points"], bytesOfPoint);
  this->Box = polygonBounds(input);
  const ClosingDistances distances(this->Box, input->GetPoints()->GetDataType() == VTK_FLOAT);
  const auto add = [&](ClosedMesh&, Progress& part) { this->AddPolygons(input, part); };
  withMemory(
    { "the table of the surface's " + std::to_string(input->GetNumberOfPoints()) + " points",
      points * 4.0 * sizeof(std::int64_t) },
    [&]() { this->Mesh.emplace(std::move(coordinates), stages["table"]); });
  const std::int64_t triangles = countTriangles(input);
  const std::string problem =
    withMemory({ "the edges of the surface's " + std::to_string(triangles) + " triangles",
                 static_cast<double>(triangles) * 110.0 },
      [&]() { return this->Mesh->Close(add, distances, stages["polygons"]); });
  if (!problem.empty())
  {
    throw Failure("The input surface " + problem);
  }
}

std::string ClosedSurface::RepairWarning() const
{
  RepairCounts counts;
  counts.TJunctions = this->Mesh->TJunctions();
  counts.Gap = this->Mesh->HadGaps() ? this->Mesh->WidestGap() : 0.0;
  return repairWarning(counts);
}

// Consecutive corners at the same point are dropped, as at the poles of a sphere of quads, and so
// are polygons with fewer than three corners left. Polygons of more than four corners follow the
// others.
void ClosedSurface::AddPolygons(vtkPolyData* input, Progress& progress)
{
  ClosedMesh& mesh = *this->Mesh;
  mesh.Reserve(countTriangles(input));
  if (isAllTriangles(input))
  {
    visitTriangles(input->GetPolys(), progress,
      [&](std::int64_t, const std::array<std::int64_t, 3>& points) { mesh.Add(points); });
    return;
  }
  PolygonCutter cutter(mesh.Points(), roundingOfPoints(mesh.Points()), makeRingCutter());
  const auto addMade = [&]() {
    const std::vector<std::int64_t>& made = cutter.Triangles();
    for (std::size_t i = 0; i < made.size(); i += 3)
    {
      mesh.Add({ made[i], made[i + 1], made[i + 2] });
    }
  };
  bool hasLarge = false;
  const auto addPolygons = [&](bool areLarge, Progress& part) {
    visitCells(
      input->GetPolys(), part, [&, areLarge](std::int64_t, const PolygonCutter::Corners& given) {
        const PolygonCutter::Corners corners = this->Merged(given);
        const bool isLarge = corners.size() > 4;
        hasLarge = hasLarge || isLarge;
        if (corners.size() > 2 && isLarge == areLarge)
        {
          cutter.CutThin(corners);
          addMade();
        }
      });
  };
  Stages stages(progress, { { "polygons", 1 }, { "large polygons", 1 }, { "strips", 1 } });
  addPolygons(false, stages["polygons"]);
  if (hasLarge)
  {
    addPolygons(true, stages["large polygons"]);
  }
  visitCells(
    input->GetStrips(), stages["strips"], [&](std::int64_t, const PolygonCutter::Corners& corners) {
      cutter.CutStrip(corners);
      addMade();
    });
}

PolygonCutter::Corners ClosedSurface::Merged(const PolygonCutter::Corners& corners) const
{
  PolygonCutter::Corners merged;
  for (const std::int64_t given : corners)
  {
    const std::int64_t corner = this->Mesh->FirstOf(given);
    if (merged.empty() || corner != merged.back())
    {
      merged.push_back(corner);
    }
  }
  while (merged.size() > 1 && merged.front() == merged.back())
  {
    merged.pop_back();
  }
  return merged;
}

SolidSurface ClosedSurface::InCells(const ImageGrid& grid, Progress& progress)
{
  Stages stages(progress, { { "points", 1 }, { "orientation", 1 } });
  this->Mesh->MoveToCells(grid, this->Box, stages["points"]);
  const std::int64_t triangles = this->Mesh->Surface().NumberOfTriangles;
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
