// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/SurfaceOrientation.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

class OrientationRun
{
public:
  OrientationRun(const TriangleSurface& surface, const SurfaceEdges& edges, std::int64_t* oriented)
    : Surface(surface)
    , Edges(edges)
    , Oriented(oriented)
    , Orientations(surface.NumberOfTriangles)
    , Queue(surface.NumberOfTriangles)
  {
    std::fill_n(this->Orientations.data(), surface.NumberOfTriangles, static_cast<signed char>(0));
  }

  SurfaceOrientation Run(Progress& progress)
  {
    const std::int64_t count = this->Orientations.size();
    progress.BeginStage(1.0, count);
    for (std::int64_t start = 0; start < count; ++start)
    {
      if (this->Orientations.data()[start] == 0)
      {
        ++this->Found.Components;
        this->OrientComponent(start, progress);
      }
    }
    return this->Found;
  }

private:
  // Orients the component of a triangle, breadth first.
  void OrientComponent(std::int64_t start, Progress& progress)
  {
    std::int64_t* queue = this->Queue.data();
    this->QueueEnd = 0;
    this->Enter(start, 1);
    double area = 0.0; // of triangles oriented as the first one, less that of the others
    for (std::int64_t next = 0; next < this->QueueEnd; ++next)
    {
      area += this->Orientations.data()[queue[next]] * this->AreaOf(queue[next]);
      this->EnterNeighbours(queue[next]);
      progress.Add(1);
    }
    const signed char keep = area < 0.0 ? -1 : 1;
    for (std::int64_t i = 0; i < this->QueueEnd; ++i)
    {
      const bool turn = this->Orientations.data()[queue[i]] != keep;
      const std::int64_t* ids = this->Surface.Triangles + 3 * queue[i];
      const std::int64_t corners[3] = { ids[0], ids[turn ? 2 : 1], ids[turn ? 1 : 2] };
      std::copy_n(corners, 3, this->Oriented + 3 * queue[i]);
    }
  }

  void Enter(std::int64_t triangle, signed char orientation)
  {
    this->Orientations.data()[triangle] = orientation;
    this->Queue.data()[this->QueueEnd++] = triangle;
  }

  void EnterNeighbours(std::int64_t triangle)
  {
    const signed char orientation = this->Orientations.data()[triangle];
    for (std::int64_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
    {
      const std::int64_t other = this->Edges.Other(side);
      if (other < 0)
      {
        continue;
      }
      // Sides of consistently oriented triangles begin at different ends of the edge.
      const bool same = this->Surface.Triangles[side] != this->Surface.Triangles[other];
      const auto wanted = static_cast<signed char>(same ? orientation : -orientation);
      const signed char found = this->Orientations.data()[other / 3];
      if (found == 0)
      {
        this->Enter(other / 3, wanted);
      }
      else if (found != wanted)
      {
        this->Found.IsOrientable = false;
      }
    }
  }

  double AreaOf(std::int64_t triangle) const
  {
    const std::int64_t* ids = this->Surface.Triangles + 3 * triangle;
    double u[3];
    double v[3];
    for (int i = 0; i < 3; ++i)
    {
      u[i] = this->Surface.Points[ids[1]][i] - this->Surface.Points[ids[0]][i];
      v[i] = this->Surface.Points[ids[2]][i] - this->Surface.Points[ids[0]][i];
    }
    return std::hypot(
      u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }

  const TriangleSurface& Surface;
  const SurfaceEdges& Edges;
  std::int64_t* Oriented;
  LargeBuffer<signed char> Orientations; // 0 not reached, 1 as the component's first, -1 opposite
  LargeBuffer<std::int64_t> Queue;       // the triangles of a component
  std::int64_t QueueEnd = 0;
  SurfaceOrientation Found{ true, 0 };
};

} // namespace

SurfaceOrientation orientSurface(const TriangleSurface& surface, const SurfaceEdges& edges,
  std::int64_t* oriented, const Context& context)
{
  Progress progress(context);
  return OrientationRun(surface, edges, oriented).Run(progress);
}

} // namespace RectifiedTransport
