// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/SurfaceEdges.h"

#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/EdgeSides.h"

#include <array>

namespace RectifiedTransport
{

SurfaceEdges::SurfaceEdges(const TriangleSurface& surface, const Context& context)
  : Others(3 * surface.NumberOfTriangles)
{
  const std::int64_t* triangles = surface.Triangles;
  Progress progress(context);
  visitEdges(
    surface.NumberOfTriangles, surface.Points.size(),
    [triangles](std::int64_t corner) { return triangles[corner]; },
    [](std::int64_t) { return false; }, progress,
    [this, triangles](
      const std::int64_t* sides, std::int64_t count) { this->Pair(triangles, sides, count); });
}

// Counts the sides of one edge, and pairs them if they are two.
void SurfaceEdges::Pair(
  const std::int64_t* triangles, const std::int64_t* sides, std::int64_t count)
{
  if (count != 2)
  {
    ++(count == 1 ? this->NumberOpen : this->NumberNonManifold);
    this->NumberOdd += count > 2 && count % 2 == 1 ? 1 : 0;
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Others.data()[sides[i]] = -1;
    }
    return;
  }
  this->Others.data()[sides[0]] = sides[1];
  this->Others.data()[sides[1]] = sides[0];
  this->NumberReversed += triangles[sides[0]] == triangles[sides[1]] ? 1 : 0;
}

// Sides of the triangles f = (a, b, c), g = (b, a, d) become those of (c, a, d), (d, b, c). Only
// the four outer sides and the new edge have other neighbours.
void flipEdge(std::int64_t* others, std::int64_t side, std::int64_t other)
{
  const std::int64_t f = side - side % 3;
  const std::int64_t g = other - other % 3;
  // What the outer sides meet; a side of these two triangles has a new number.
  const auto metBy = [=](std::int64_t outer) {
    const std::int64_t met = others[outer];
    return met == nextSide(side) ? g + 1
      : met == lastSide(side)    ? f
      : met == nextSide(other)   ? f + 1
      : met == lastSide(other)   ? g
                                 : met;
  };
  const std::array<std::array<std::int64_t, 2>, 5> pairs{ { { f, metBy(lastSide(side)) },
    { f + 1, metBy(nextSide(other)) }, { f + 2, g + 2 }, { g, metBy(lastSide(other)) },
    { g + 1, metBy(nextSide(side)) } } };
  for (const auto& [one, two] : pairs)
  {
    others[one] = two;
    if (two >= 0)
    {
      others[two] = one;
    }
  }
}

} // namespace RectifiedTransport
