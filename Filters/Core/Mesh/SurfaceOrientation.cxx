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

class PatchSearch
{
public:
  PatchSearch(const TriangleSurface& surface, const SurfaceEdges& edges, signed char* signs)
    : Surface(surface)
    , Edges(edges)
    , Signs(signs)
    , Queue(surface.NumberOfTriangles)
  {
    std::fill_n(this->Signs, surface.NumberOfTriangles, static_cast<signed char>(0));
  }

  bool Run(Progress& progress, const std::function<void(const SurfacePatch&)>& visit)
  {
    for (std::int64_t start = 0; start < this->Queue.size(); ++start)
    {
      if (this->Signs[start] == 0)
      {
        visit(this->Find(start, progress));
      }
    }
    return this->IsOrientable;
  }

private:
  // The patch of a triangle, breadth first.
  SurfacePatch Find(std::int64_t start, Progress& progress)
  {
    std::int64_t* queue = this->Queue.data();
    this->QueueEnd = 0;
    this->Enter(start, 1);
    double area = 0.0; // of triangles oriented as the first one, less that of the others
    for (std::int64_t next = 0; next < this->QueueEnd; ++next)
    {
      area += this->Signs[queue[next]] * this->AreaOf(queue[next]);
      this->EnterNeighbours(queue[next]);
      progress.Add(1);
    }
    for (std::int64_t i = 0; area < 0.0 && i < this->QueueEnd; ++i)
    {
      this->Signs[queue[i]] = static_cast<signed char>(-this->Signs[queue[i]]);
    }
    return { queue, this->QueueEnd, std::abs(area) };
  }

  void Enter(std::int64_t triangle, signed char sign)
  {
    this->Signs[triangle] = sign;
    this->Queue.data()[this->QueueEnd++] = triangle;
  }

  void EnterNeighbours(std::int64_t triangle)
  {
    const signed char sign = this->Signs[triangle];
    for (std::int64_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
    {
      const std::int64_t other = this->Edges.Other(side);
      if (other < 0)
      {
        continue;
      }
      // Sides of consistently oriented triangles begin at different ends of the edge.
      const bool same = this->Surface.Triangles[side] != this->Surface.Triangles[other];
      const auto wanted = static_cast<signed char>(same ? sign : -sign);
      const signed char found = this->Signs[other / 3];
      if (found == 0)
      {
        this->Enter(other / 3, wanted);
      }
      else if (found != wanted)
      {
        this->IsOrientable = false;
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
  signed char* const Signs;        // 0 not reached, 1 as given, -1 opposite
  LargeBuffer<std::int64_t> Queue; // the triangles of a patch
  std::int64_t QueueEnd = 0;
  bool IsOrientable = true;
};

} // namespace

bool visitPatches(const TriangleSurface& surface, const SurfaceEdges& edges, signed char* signs,
  Progress& progress, const std::function<void(const SurfacePatch&)>& visit)
{
  return PatchSearch(surface, edges, signs).Run(progress, visit);
}

SurfaceOrientation orientSurface(const TriangleSurface& surface, const SurfaceEdges& edges,
  std::int64_t* oriented, const Context& context)
{
  const std::int64_t count = surface.NumberOfTriangles;
  LargeBuffer<signed char> signs(count);
  SurfaceOrientation found{ true, 0 };
  Progress progress(context);
  progress.Expect(count);
  found.IsOrientable =
    visitPatches(surface, edges, signs.data(), progress, [&](const SurfacePatch& patch) {
      ++found.Components;
      for (std::int64_t i = 0; i < patch.Count; ++i)
      {
        const std::int64_t triangle = patch.Triangles[i];
        const bool turn = signs.data()[triangle] < 0;
        const std::int64_t* ids = surface.Triangles + 3 * triangle;
        const std::int64_t corners[3] = { ids[0], ids[turn ? 2 : 1], ids[turn ? 1 : 2] };
        std::copy_n(corners, 3, oriented + 3 * triangle);
      }
    });
  return found;
}

} // namespace RectifiedTransport
