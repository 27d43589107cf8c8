// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Solid/ClosedSurface.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Solid/SolidTriangles.h"
#include "Bridge/Surface/PolygonInput.h"
#include "Bridge/Surface/RepairText.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

// Of T-junctions, as a share of the longest side of the bounds.
constexpr std::array<double, 4> gaps{ 1e-5, 1e-4, 1e-3, 1e-2 };

// The largest coordinate, without its sign.
double farthestIn(const std::array<double, 6>& bounds)
{
  return std::accumulate(bounds.begin(), bounds.end(), 0.0,
    [](double farthest, double x) { return std::max(farthest, std::abs(x)); });
}

double longestSideOf(const std::array<double, 6>& bounds)
{
  return std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
}

// Distances within which points may differ by rounding: of any coordinates, and of float ones.
std::array<double, 2> roundingsIn(const std::array<double, 6>& bounds, bool isFloat)
{
  constexpr double units = 4.0;
  const double near = ClosedMesh::NearDistance * longestSideOf(bounds);
  return { std::isfinite(near) ? near : 0.0,
    isFloat ? units * farthestIn(bounds) * std::numeric_limits<float>::epsilon() : 0.0 };
}

// Four units in the last place of the largest coordinate, a power of two; 0 if there is none.
double lastPlacesIn(const std::array<double, 6>& bounds)
{
  const double farthest = farthestIn(bounds);
  const double places = farthest > 0.0 ? std::ldexp(1.0, std::ilogb(farthest) - 50) : 0.0;
  return places >= std::numeric_limits<double>::min() ? places : 0.0;
}

} // namespace

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
  : NumberOfPoints(input->GetNumberOfPoints())
{
  const std::string points = std::to_string(this->NumberOfPoints) + " points";
  constexpr double bytesOfPoint = 64.0; // with the table
  Stages stages(progress,
    { { "points", 10 }, { "table", 15 }, { "polygons", 45 }, { "rounding", 15 },
      { "float rounding", 5 }, { "gaps", 10 } });
  LargeBuffer<double> coordinates =
    readSurfacePoints(input, "a solid needs a closed surface", stages["points"], bytesOfPoint);
  this->Box = polygonBounds(input);
  this->Rounding = lastPlacesIn(this->Box);
  withMemory("the table of the surface's " + points,
    static_cast<double>(this->NumberOfPoints) * 4.0 * sizeof(std::int64_t),
    [&]() { this->Mesh.emplace(std::move(coordinates), stages["table"]); });
  std::string problem;
  try
  {
    this->ReadPolygons(input, stages["polygons"]);
    if (this->Mesh->IsClosed())
    {
      return;
    }
    problem = this->Openness();
  }
  catch (const Failure& failure)
  {
    problem = failure.what(); // corners that differ by rounding may be the reason
  }
  const std::array<double, 2> roundings =
    roundingsIn(this->Box, input->GetPoints()->GetDataType() == VTK_FLOAT);
  if (this->CloseNear(input, roundings[0], stages["rounding"]))
  {
    return;
  }
  problem =
    this->Mesh->OpenEdges() + this->Mesh->NonManifoldEdges() > 0 ? this->Openness() : problem;
  if (!this->CloseNear(input, roundings[1], stages["float rounding"]) &&
    !this->CloseGaps(stages["gaps"]))
  {
    throw Failure(problem);
  }
}

std::string ClosedSurface::RepairWarning() const
{
  RepairCounts counts;
  counts.TJunctions = this->Mesh->TJunctions();
  counts.Gap = this->HasGaps ? this->Mesh->WidestGap() : 0.0;
  return repairWarning(counts);
}

// Merges points nearer than a distance, and cuts triangles at T-junctions within it; returns
// whether that closes the surface.
bool ClosedSurface::CloseNear(vtkPolyData* input, double distance, Progress& progress)
{
  Stages stages(progress, { { "points", 3 }, { "polygons", 4 }, { "T-junctions", 3 } });
  const std::string points = std::to_string(this->NumberOfPoints) + " points";
  const bool isMerged = distance > 0.0 &&
    withMemory("the table of the surface's " + points,
      static_cast<double>(this->NumberOfPoints) * 9.0 * sizeof(std::int64_t),
      [&]() { return this->Mesh->MergeNear(distance, stages["points"]); });
  if (isMerged)
  {
    try
    {
      this->ReadPolygons(input, stages["polygons"]);
    }
    catch (const Failure&)
    {
      return false; // what was wrong before is said
    }
  }
  if (isMerged && this->Mesh->IsClosed())
  {
    return true;
  }
  return this->CloseTJunctions(distance, stages["T-junctions"]);
}

// Cuts triangles at T-junctions that gape by more than rounding: no more than it takes to close the
// surface.
bool ClosedSurface::CloseGaps(Progress& progress)
{
  Parts parts(progress, static_cast<std::int64_t>(gaps.size()));
  for (std::size_t i = 0; i < gaps.size() && !this->HasGaps; ++i)
  {
    this->HasGaps = this->CloseTJunctions(
      gaps[i] * longestSideOf(this->Box), parts[static_cast<std::int64_t>(i)]);
  }
  return this->HasGaps;
}

// Returns whether that closes the surface.
bool ClosedSurface::CloseTJunctions(double distance, Progress& progress)
{
  const std::int64_t triangles = this->Mesh->Surface().NumberOfTriangles;
  return triangles > 0 && distance > 0.0 && std::isfinite(distance) &&
    withMemory("the edges of the surface's " + std::to_string(triangles) + " triangles",
      static_cast<double>(triangles) * 110.0,
      [&]() { return this->Mesh->CloseTJunctions(distance, progress); });
}

void ClosedSurface::ReadPolygons(vtkPolyData* input, Progress& progress)
{
  Stages stages(progress, { { "cut", 2 }, { "triangles", 3 }, { "edges", 5 } });
  const vtkSmartPointer<vtkCellArray> triangles =
    cutIntoTriangles(input, *this->Mesh, stages["cut"]);
  withMemory("the surface's " + std::to_string(triangles->GetNumberOfCells()) + " triangles",
    static_cast<double>(triangles->GetNumberOfCells()) * 9.0 * sizeof(std::int64_t), [&]() {
      this->ReadTriangles(triangles, stages["triangles"]);
      this->Mesh->CountEdges(stages["edges"]);
    });
  if (this->Mesh->Surface().NumberOfTriangles == 0)
  {
    throw Failure("The input surface has each polygon twice, in opposite directions, so that "
                  "nothing is inside; keep one of each");
  }
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

std::string ClosedSurface::Openness() const
{
  const std::int64_t open = this->Mesh->OpenEdges();
  const std::int64_t nonManifold = this->Mesh->NonManifoldEdges();
  std::ostringstream message;
  message << "The input surface is not closed: it has " << open
          << (open == 1 ? " open edge" : " open edges") << " and " << nonManifold
          << (nonManifold == 1 ? " non-manifold edge" : " non-manifold edges")
          << "; every edge must be one of two triangles, or of another even number";
  if (open > 0)
  {
    message
      << ". To close it: Clip Closed Surface in place of Clip, or with a plane that cuts off "
         "the rim of the hole; Capping of sources and extrusions; Clean with a Tolerance where "
         "seams gape, after Subdivide if one of their sides has fewer points; vtkFillHolesFilter "
         "in a Programmable Filter; or Delaunay 3D and Extract Surface for the convex hull";
  }
  return message.str();
}

SolidSurface ClosedSurface::InCells(const ImageGrid& grid, Progress& progress)
{
  Stages stages(progress, { { "points", 1 }, { "orientation", 1 } });
  double* points = this->Mesh->Points().data();
  const double spacing = grid.Spacing()[0];
  const Eigen::Vector3d corner = grid.Origin();
  const double rounding = this->Rounding;
  stages["points"].For(this->NumberOfPoints, Grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        double& x = points[3 * i + static_cast<std::int64_t>(a)];
        const double rounded = rounding > 0.0 ? std::nearbyint(x / rounding) * rounding : x;
        x = (rounded - corner[static_cast<Eigen::Index>(a)]) / spacing;
      }
    }
  });
  const std::int64_t triangles = this->Mesh->Surface().NumberOfTriangles;
  const bool oriented = withMemory("the orientation of the surface's triangles",
    static_cast<double>(triangles) * (2 * sizeof(std::int64_t) + 1),
    [&]() { return this->Mesh->Orient(stages["orientation"]); });
  if (!oriented)
  {
    throw Failure("The input surface is not orientable: it has one side only, as a Klein bottle; "
                  "a solid needs a surface with an inside");
  }
  return this->Mesh->Solid();
}

} // namespace RectifiedTransport::Bridge
