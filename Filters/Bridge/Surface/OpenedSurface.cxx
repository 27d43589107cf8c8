// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/OpenedSurface.h"

#include "Bridge/Points/CopiedTuples.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"
#include "Bridge/Surface/RepairText.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

} // namespace

OpenedSurface::OpenedSurface(SurfaceTriangles& input, Progress& progress)
  : Input(std::move(input))
{
  Stages stages(progress, { { "T-junctions", 5 }, { "seams", 93 }, { "points", 2 } });
  this->Input.CloseTJunctions(TJunctionScope::All, stages["T-junctions"]);
  const std::int64_t points = this->Given().Points.size();
  const std::int64_t triangles = this->Given().NumberOfTriangles;
  constexpr double bytesOfTriangle = 250.0;
  constexpr double bytesOfPoint = 1350.0; // of the conformal map
  try
  {
    withMemory("the seams of " + std::to_string(triangles) + " triangles",
      static_cast<double>(triangles) * bytesOfTriangle + static_cast<double>(points) * bytesOfPoint,
      [&]() {
        SeamOptions options;
        options.Rounding = this->Input.Rounding();
        this->Disks.emplace(this->Given(), options, stages["seams"]);
        this->NumberPoints(stages["points"]);
      });
  }
  catch (const std::exception& error)
  {
    if (dynamic_cast<const NotADisk*>(&error) || dynamic_cast<const std::invalid_argument*>(&error))
    {
      throw Failure(std::string("The input surface ") + error.what());
    }
    throw;
  }
}

// The first copy of a point has its number.
void OpenedSurface::NumberPoints(Progress& progress)
{
  const std::int64_t given = this->Given().Points.size();
  const std::int64_t corners = 3 * this->Given().NumberOfTriangles;
  this->CutPoints.assign(static_cast<std::size_t>(given), -1);
  this->Origins.resize(static_cast<std::size_t>(given));
  for (std::int64_t point = 0; point < given; ++point)
  {
    this->Origins[static_cast<std::size_t>(point)] = point;
  }
  this->NextCopy.assign(static_cast<std::size_t>(given), -1);
  this->OutputCorners = LargeBuffer<std::int64_t>(corners);
  progress.ForInOrder(
    corners, Grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t corner = first; corner < last; ++corner)
      {
        const std::int64_t point = this->Given().Triangles[corner];
        const std::int64_t wanted = this->Disks->CornersOf(corner / 3)[corner % 3];
        std::int64_t& own = this->CutPoints[static_cast<std::size_t>(point)];
        own = own < 0 ? wanted : own;
        this->OutputCorners.data()[corner] = wanted < 0 ? point : this->CopyAt(point, wanted);
      }
    },
    RandomAccessUnits);
  for (std::int64_t point = 0; point < given; ++point)
  {
    std::int64_t& cutPoint = this->CutPoints[static_cast<std::size_t>(point)];
    cutPoint = cutPoint < 0 ? this->Disks->PointOf(point) : cutPoint;
  }
}

// The copy of a point of the input that is at a point of the cut surface.
std::int64_t OpenedSurface::CopyAt(std::int64_t given, std::int64_t cutPoint)
{
  std::int64_t copy = given;
  while (this->PointOf(copy) != cutPoint)
  {
    std::int64_t& next = this->NextCopy[static_cast<std::size_t>(copy)];
    if (next >= 0)
    {
      copy = next;
      continue;
    }
    copy = next = this->NumberOfPoints();
    this->NextCopy.push_back(-1);
    this->CutPoints.push_back(cutPoint);
    this->Origins.push_back(given);
  }
  return copy;
}

// Where the copies of the points at the place of a corner are.
std::vector<std::int64_t> OpenedSurface::PlacesOf(std::int64_t corner) const
{
  const std::int64_t own = this->Disks->PointOf(this->Given().Triangles[corner]);
  const std::int64_t first = corner - corner % 3;
  std::vector<std::int64_t> places;
  for (std::int64_t i = first; i < first + 3; ++i)
  {
    const std::int64_t given = this->Given().Triangles[i];
    if (this->Disks->PointOf(given) != own)
    {
      continue;
    }
    for (std::int64_t copy = given; copy >= 0;
         copy = this->NextCopy[static_cast<std::size_t>(copy)])
    {
      places.push_back(this->PointOf(copy));
    }
  }
  return places;
}

void OpenedSurface::PlaceFlatCells(ConstPointSpan<2> positions)
{
  const auto distance = [&](std::int64_t a, std::int64_t b) {
    const double* p = positions[a];
    const double* q = positions[b];
    return std::max(std::abs(p[0] - q[0]), std::abs(p[1] - q[1]));
  };
  for (std::int64_t corner = 0; corner < this->OutputCorners.size(); corner += 3)
  {
    const std::int64_t* given = this->Given().Triangles + corner;
    const bool isPlaced = std::all_of(
      given, given + 3, [this](std::int64_t point) { return this->Disks->PointOf(point) >= 0; });
    if (this->Disks->DiskOf(corner / 3) >= 0 || !isPlaced)
    {
      continue;
    }
    double least = std::numeric_limits<double>::infinity();
    std::array<std::int64_t, 3> nearest{};
    for (const std::int64_t a : this->PlacesOf(corner))
    {
      for (const std::int64_t b : this->PlacesOf(corner + 1))
      {
        for (const std::int64_t c : this->PlacesOf(corner + 2))
        {
          const double longest = std::max({ distance(a, b), distance(b, c), distance(c, a) });
          if (longest < least)
          {
            least = longest;
            nearest = { a, b, c };
          }
        }
      }
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->OutputCorners.data()[corner + static_cast<std::int64_t>(i)] =
        this->CopyAt(given[i], nearest[i]);
    }
  }
}

void OpenedSurface::CopyTo(vtkPolyData* output, Progress& progress) const
{
  vtkPolyData* from = this->Triangulated();
  vtkNew<vtkPoints> points;
  points->SetDataType(from->GetPoints()->GetDataType());
  const std::int64_t count = this->NumberOfPoints();
  requireMemory("the points of the surface with its seams",
    static_cast<double>(count) * 3.0 * points->GetData()->GetDataTypeSize());
  points->SetNumberOfPoints(static_cast<vtkIdType>(count));
  for (std::int64_t point = 0; point < count; ++point)
  {
    points->SetPoint(static_cast<vtkIdType>(point),
      from->GetPoints()->GetPoint(static_cast<vtkIdType>(this->OriginOf(point))));
  }
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(
    static_cast<vtkIdType>(this->OutputCorners.size() / 3), this->OutputCorners.size());
  for (std::int64_t corner = 0; corner < this->OutputCorners.size(); corner += 3)
  {
    const std::int64_t* ids = this->OutputCorners.data() + corner;
    triangles->InsertNextCell({ static_cast<vtkIdType>(ids[0]), static_cast<vtkIdType>(ids[1]),
      static_cast<vtkIdType>(ids[2]) });
  }
  output->SetPoints(points);
  output->SetVerts(from->GetVerts());
  output->SetLines(from->GetLines());
  output->SetPolys(triangles);
  output->GetFieldData()->PassData(from->GetFieldData());
  output->GetCellData()->PassData(from->GetCellData());
  copyTuples(
    { from->GetPointData(), from->GetNumberOfPoints(), "point", "input surface" }, count,
    [this](vtkIdType point) { return static_cast<vtkIdType>(this->OriginOf(point)); },
    output->GetPointData(), progress);
}

std::string OpenedSurface::RepairWarning() const
{
  const SurfaceCuts& cuts = this->Disks->Cuts();
  RepairCounts counts;
  counts.UnusedPoints = cuts.UnusedPoints;
  counts.FlatTriangles = cuts.FlatTriangles + this->Input.FlatTriangles();
  counts.MergedPoints = cuts.MergedPoints;
  counts.Repeated = cuts.Repeated;
  counts.TJunctions = this->Input.TJunctions();
  counts.PartedEdges = cuts.NonManifoldEdges;
  return repairWarning(counts);
}

} // namespace RectifiedTransport::Bridge
