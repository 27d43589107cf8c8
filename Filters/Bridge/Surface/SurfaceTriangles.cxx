// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/SurfaceTriangles.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport::Bridge
{

SurfaceTriangles::SurfaceTriangles(vtkPolyData* input, const std::string& need, Progress& progress)
{
  Stages stages(progress, { { "points", 2 }, { "triangles", 7 }, { "corners", 1 } });
  this->Coordinates = readSurfacePoints(input, need, stages["points"]);
  this->RoundingOfPoints = roundingOf(input->GetPoints());
  this->Triangulated.emplace(input, stages["triangles"]);
  const std::int64_t triangles = this->Cells().NumberOfTriangles();
  withMemory("the surface's " + std::to_string(triangles) + " triangles",
    static_cast<double>(triangles) * 3.0 * sizeof(std::int64_t),
    [&]() { this->Corners = this->Cells().Corners(stages["corners"]); });
}

bool SurfaceTriangles::CloseTJunctions(TJunctionScope scope, Progress& progress)
{
  if (!std::exchange(this->IsSearched, true))
  {
    const std::int64_t triangles = this->Cells().NumberOfTriangles();
    withMemory("the edges of the surface's " + std::to_string(triangles) + " triangles",
      static_cast<double>(triangles) * 150.0 + static_cast<double>(this->Coordinates.size()) * 24.0,
      [&]() { this->Cut(scope, progress); });
  }
  return this->Split.has_value();
}

void SurfaceTriangles::Cut(TJunctionScope scope, Progress& progress)
{
  Stages stages(progress, { { "T-junctions", 8 }, { "parts", 2 } });
  TJunctionRepair repair = repairTJunctions(this->Surface(), scope, stages["T-junctions"]);
  if (repair.Parts)
  {
    this->NumberOfTJunctions = repair.TJunctions;
    this->NumberOfFlat = repair.FlatTriangles;
    this->Split = std::move(repair.Parts);
    this->Corners = LargeBuffer<std::int64_t>(3 * this->Split->NumberOfTriangles());
    std::copy_n(this->Split->Triangles(), this->Corners.size(), this->Corners.data());
    this->Triangulated->Cut(*this->Split, stages["parts"]);
  }
}

void SurfaceTriangles::Free()
{
  this->Coordinates = {};
  this->Corners = {};
}

} // namespace RectifiedTransport::Bridge
