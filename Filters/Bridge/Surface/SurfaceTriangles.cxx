// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/SurfaceTriangles.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"
#include "Core/Mesh/MergePoints.h"
#include "Core/Mesh/TJunctions.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Open sides and T-junctions of points that were merged.
struct OpenEdges
{
  std::vector<OpenSide> Sides;
  std::vector<TJunction> Junctions;
};

OpenEdges findOpenEdges(const TriangleSurface& surface, const LargeBuffer<std::int64_t>& merged,
  double rounding, Progress& progress)
{
  Progress own(progress.Stage());
  own.BeginStage(0.7);
  OpenEdges found;
  found.Sides = openSidesOf(surface, merged.data(), own);
  own.BeginStage(1.0);
  found.Junctions = findTJunctions(surface.Points, found.Sides, rounding, own);
  return found;
}

// Gives T-junctions, for a merged point, the one that the first open side there has.
void unmerge(const TriangleSurface& surface, OpenEdges& edges)
{
  std::vector<std::pair<std::int64_t, std::int64_t>> points;
  points.reserve(2 * edges.Sides.size());
  for (const OpenSide& side : edges.Sides)
  {
    points.emplace_back(side.From, surface.Triangles[side.Side]);
    points.emplace_back(side.To, surface.Triangles[nextSide(side.Side)]);
  }
  std::sort(points.begin(), points.end());
  for (TJunction& junction : edges.Junctions)
  {
    junction.Point =
      std::lower_bound(points.begin(), points.end(), std::make_pair(junction.Point, std::int64_t{}))
        ->second;
  }
}

} // namespace

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

bool SurfaceTriangles::CloseTJunctions(Progress& progress)
{
  if (!std::exchange(this->IsSearched, true))
  {
    const std::int64_t triangles = this->Cells().NumberOfTriangles();
    withMemory("the edges of the surface's " + std::to_string(triangles) + " triangles",
      static_cast<double>(triangles) * 70.0 + static_cast<double>(this->Coordinates.size()) * 24.0,
      [&]() { this->FindTJunctions(progress); });
  }
  return this->Split.has_value();
}

void SurfaceTriangles::FindTJunctions(Progress& progress)
{
  Progress own(progress.Stage());
  const TriangleSurface surface = this->Surface();
  LargeBuffer<std::int64_t> merged(surface.Points.size());
  own.BeginStage(0.05);
  const double rounding = roundingOfCorners(surface, own);
  own.BeginStage(0.1);
  mergePoints(surface.Points, merged.data(), own.Stage());
  own.BeginStage(0.3);
  OpenEdges edges = findOpenEdges(surface, merged, rounding, own);
  if (rounding > 0.0 && !edges.Sides.empty())
  {
    // Where points at one place differ by rounding.
    own.BeginStage(0.45);
    const bool isMerged = mergeNearPoints(surface.Points, rounding, merged.data(), own.Stage());
    own.BeginStage(0.7);
    if (isMerged)
    {
      OpenEdges near = findOpenEdges(surface, merged, rounding, own);
      if (near.Sides.size() < edges.Sides.size() && near.Junctions.size() > edges.Junctions.size())
      {
        edges = std::move(near);
      }
    }
  }
  if (!edges.Junctions.empty())
  {
    unmerge(surface, edges);
    own.BeginStage(0.8);
    this->Split.emplace(surface, edges.Junctions, own);
    this->Corners = LargeBuffer<std::int64_t>(3 * this->Split->NumberOfTriangles());
    std::copy_n(this->Split->Triangles(), this->Corners.size(), this->Corners.data());
    own.BeginStage(1.0);
    this->Triangulated->Cut(*this->Split, own);
  }
}

void SurfaceTriangles::Free()
{
  this->Coordinates = {};
  this->Corners = {};
}

} // namespace RectifiedTransport
