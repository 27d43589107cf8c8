// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Solid/ClosedMesh.h"

#include "Core/Parallel/Progress.h"
#include "Core/Mesh/MergePoints.h"
#include "Core/Mesh/SurfaceEdges.h"
#include "Core/Mesh/SurfaceOrientation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
// Units of a slice of work with random memory access.
constexpr std::int64_t slow = std::int64_t{ 1 } << 16;

void copyPoints(ConstPointSpan<3> points, double* copy, Progress& progress)
{
  progress.ForInOrder(points.size(), grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const double* point = points[i];
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
      {
        throw std::invalid_argument("point " + std::to_string(i) + " is not finite");
      }
      std::copy_n(point, 3, copy + 3 * i);
    }
  });
}

void addTriangles(const TriangleSurface& surface, Progress& progress, ClosedMesh& mesh)
{
  const std::int64_t points = surface.Points.size();
  progress.ForInOrder(
    surface.NumberOfTriangles, grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        std::array<std::int64_t, 3> corners;
        std::copy_n(surface.Triangles + 3 * i, 3, corners.begin());
        for (const std::int64_t corner : corners)
        {
          if (corner < 0 || corner >= points)
          {
            throw std::invalid_argument("triangle " + std::to_string(i) + " has the point " +
              std::to_string(corner) + ", but there are " + std::to_string(points) + " points");
          }
        }
        mesh.Add(corners);
      }
    },
    slow);
}

} // namespace

ClosedMesh::ClosedMesh(const TriangleSurface& surface, const Context& context)
  : Coordinates(3 * surface.Points.size())
{
  Progress progress(context);
  progress.BeginStage(0.1);
  copyPoints(surface.Points, this->Coordinates.data(), progress);
  progress.BeginStage(0.4);
  this->Merge(progress.Stage());
  this->Reserve(surface.NumberOfTriangles);
  progress.BeginStage(0.6);
  addTriangles(surface, progress, *this);
  progress.BeginStage(1.0);
  this->CountEdges(progress.Stage());
}

ClosedMesh::ClosedMesh(LargeBuffer<double> coordinates, const Context& context)
  : Coordinates(std::move(coordinates))
{
  this->Merge(context);
}

ClosedMesh::~ClosedMesh() = default;
ClosedMesh::ClosedMesh(ClosedMesh&&) noexcept = default;
ClosedMesh& ClosedMesh::operator=(ClosedMesh&&) noexcept = default;

void ClosedMesh::Merge(const Context& context)
{
  const ConstPointSpan<3> points = this->Points();
  this->Firsts = LargeBuffer<std::int64_t>(points.size());
  mergePoints(points, this->Firsts.data(), context);
}

void ClosedMesh::Reserve(std::int64_t triangles)
{
  this->Triangles = LargeBuffer<std::int64_t>(3 * triangles);
}

void ClosedMesh::Add(const std::array<std::int64_t, 3>& corners)
{
  const std::int64_t a = this->FirstOf(corners[0]);
  const std::int64_t b = this->FirstOf(corners[1]);
  const std::int64_t c = this->FirstOf(corners[2]);
  if (a != b && b != c && c != a)
  {
    std::int64_t* triangle = this->Triangles.data() + 3 * this->NumberOfTriangles++;
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
  }
}

void ClosedMesh::CountEdges(const Context& context)
{
  this->Firsts = {}; // its memory is needed now
  this->Edges = std::make_unique<SurfaceEdges>(this->Surface(), context);
  this->NumberOpen = this->Edges->Open();
  this->NumberNonManifold = this->Edges->NonManifold();
  this->Closed = this->NumberOpen == 0 && this->NumberNonManifold == 0;
}

bool ClosedMesh::Orient(const Context& context)
{
  if (this->Closed && this->Edges)
  {
    this->Oriented = this->Edges->Reversed() == 0 ||
      orientSurface(this->Surface(), *this->Edges, this->Triangles.data(), context).IsOrientable;
    this->Edges.reset(); // no longer of these triangles
  }
  return this->Oriented;
}

TriangleSurface ClosedMesh::Surface() const
{
  return { { this->Coordinates.data(), this->Coordinates.size() / 3 }, this->Triangles.data(),
    this->NumberOfTriangles };
}

} // namespace RectifiedTransport
