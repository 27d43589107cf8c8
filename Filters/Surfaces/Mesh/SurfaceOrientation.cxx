// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/SurfaceOrientation.h"

#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

// Twice the area: only signs of sums matter to the orientation.
double areaOf(const TriangleSurface& surface, std::int64_t triangle)
{
  const std::int64_t* ids = surface.Triangles + 3 * triangle;
  const Point<3> a = pointAt(surface.Points, ids[0]);
  const Point<3> normal =
    cross(pointAt(surface.Points, ids[1]) - a, pointAt(surface.Points, ids[2]) - a);
  return std::hypot(normal[0], normal[1], normal[2]);
}

} // namespace

bool visitPatches(const TriangleSurface& surface, const SurfaceEdges& edges, signed char* signs,
  Progress& progress, const std::function<void(const SurfacePatch&)>& visit)
{
  // Queue of a patch's triangles, breadth first.
  LargeBuffer<std::int64_t> triangles(surface.NumberOfTriangles);
  std::int64_t* queue = triangles.data();
  std::fill_n(signs, surface.NumberOfTriangles, static_cast<signed char>(0)); // 0: not reached yet
  bool isOrientable = true;
  for (std::int64_t start = 0; start < surface.NumberOfTriangles; ++start)
  {
    if (signs[start] != 0)
    {
      continue;
    }
    std::int64_t end = 0;
    // Triangles are marked when they enter the queue, so that each enters once.
    const auto enter = [&](std::int64_t triangle, int sign) {
      signs[triangle] = static_cast<signed char>(sign);
      queue[end++] = triangle;
    };
    enter(start, 1);
    double area = 0.0; // area of triangles oriented as the first one minus that of the others
    for (std::int64_t next = 0; next < end; ++next)
    {
      const int sign = signs[queue[next]];
      area += sign * areaOf(surface, queue[next]);
      for (std::int64_t side = 3 * queue[next]; side < 3 * queue[next] + 3; ++side)
      {
        const std::int64_t other = edges.Other(side);
        if (other < 0)
        {
          continue;
        }
        // Sides of consistently oriented triangles begin at different ends of the edge.
        const bool same = surface.Triangles[side] != surface.Triangles[other];
        const int wanted = same ? sign : -sign;
        const int found = signs[other / 3];
        // A triangle that was reached with the other sign makes a one-sided strip.
        isOrientable = isOrientable && (found == 0 || found == wanted);
        if (found == 0)
        {
          enter(other / 3, wanted);
        }
      }
      progress.Add(1);
    }
    // The larger part of the area keeps its orientation.
    for (std::int64_t i = 0; area < 0.0 && i < end; ++i)
    {
      signs[queue[i]] = static_cast<signed char>(-signs[queue[i]]);
    }
    visit({ queue, end, std::abs(area) });
  }
  return isOrientable;
}

// Writes may go to the surface's own memory: each triangle is read before it is written.
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
