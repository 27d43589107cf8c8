// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/SurfaceTriangles.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport::Bridge
{

SurfaceTriangles::SurfaceTriangles(
  vtkPolyData* input, const std::string& need, Progress& progress, double end)
{
  const SurfaceStages stages{ progress, progress.StageEnd(), end };
  stages.Next(0.2);
  this->Coordinates = readSurfacePoints(input, need, progress);
  this->RoundingOfPoints = roundingOf(input->GetPoints());
  this->Triangulated.emplace(input, stages, 0.9);
  const std::int64_t triangles = this->Cells().NumberOfTriangles();
  stages.Next(1.0);
  withMemory("the surface's " + std::to_string(triangles) + " triangles",
    static_cast<double>(triangles) * 3.0 * sizeof(std::int64_t),
    [&]() { this->Corners = this->Cells().Corners(progress); });
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
  Progress own(progress.Stage());
  own.BeginStage(0.8);
  TJunctionRepair repair = repairTJunctions(this->Surface(), scope, own.Stage());
  own.BeginStage(1.0);
  if (repair.Parts)
  {
    this->NumberOfTJunctions = repair.TJunctions;
    this->NumberOfFlat = repair.FlatTriangles;
    this->Split = std::move(repair.Parts);
    this->Corners = LargeBuffer<std::int64_t>(3 * this->Split->NumberOfTriangles());
    std::copy_n(this->Split->Triangles(), this->Corners.size(), this->Corners.data());
    this->Triangulated->Cut(*this->Split, own);
  }
}

void SurfaceTriangles::Free()
{
  this->Coordinates = {};
  this->Corners = {};
}

} // namespace RectifiedTransport::Bridge
