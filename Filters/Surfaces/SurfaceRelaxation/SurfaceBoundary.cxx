// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/SurfaceBoundary.h"

#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/SurfaceEdges.h"

#include <algorithm>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// A test of a box costs less than a side's distance; 16 sides keep the tree small.
constexpr std::int64_t sidesOfLeaf = 16;

} // namespace

SurfaceBoundary::SurfaceBoundary(const GeodesicTracer& tracer, Progress& progress)
  : Tracer(tracer)
{
  // Counted first, so that the memory is what they need.
  const auto forSides = [&](const auto& visit) {
    for (std::int64_t triangle = 0; triangle < tracer.NumberOfTriangles(); ++triangle)
    {
      for (std::int64_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
      {
        if (tracer.Across(side) == GeodesicTracer::Boundary && tracer.Area(triangle) > 0.0)
        {
          visit(side);
        }
      }
      progress.Add(1);
    }
  };
  std::size_t count = 0;
  forSides([&](std::int64_t) { ++count; });
  std::vector<std::int64_t> sides;
  sides.reserve(count);
  forSides([&](std::int64_t side) { sides.push_back(side); });
  this->Sides.emplace(
    std::move(sides), sidesOfLeaf,
    [&tracer](std::int64_t side, PointBounds& box) {
      box.Add(tracer.Start(side).data());
      box.Add(tracer.Start(nextSide(side)).data());
    },
    [&tracer](std::int64_t side, std::size_t axis) {
      // Sides are divided by their middles.
      return 0.5 * (tracer.Start(side)[axis] + tracer.Start(nextSide(side))[axis]);
    },
    progress);
}

double SurfaceBoundary::MemoryFor(double sides)
{
  // Leaves are half full or more, about; the vector of boxes doubles as it grows.
  return sides * (sizeof(std::int64_t) + 3.0 * 2.0 * sizeof(ItemBox) / (0.5 * sidesOfLeaf));
}

// The gap between boxes bounds the distance of their contents from below.
void SurfaceBoundary::FindNear(
  const DotBox& box, double distance, std::vector<std::int64_t>& found) const
{
  found.clear();
  this->Sides->VisitNear(
    [&](const PointBounds& part) {
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double gap =
          std::max({ part.Low[axis] - box.High[axis], box.Low[axis] - part.High[axis], 0.0 });
        squared += gap * gap;
      }
      return squared < distance * distance;
    },
    [&found](std::int64_t side) { found.push_back(side); });
}

// The projection on each side is clamped to its ends.
Point<3> SurfaceBoundary::FromNearest(
  const std::vector<std::int64_t>& sides, const Point<3>& x) const
{
  double least = std::numeric_limits<double>::infinity();
  Point<3> nearest{ least, least, least };
  for (const std::int64_t side : sides)
  {
    const Point<3> from = x - this->Tracer.Start(side);
    const Point<3> edge = this->Tracer.Edge(side);
    // The nearest point of a side is start + place edge, place = from . edge / |edge|^2 within [0,
    // 1].
    const double place = std::clamp(dot(from, edge) / dot(edge, edge), 0.0, 1.0);
    const Point<3> gap = from - place * edge;
    if (dot(gap, gap) < least)
    {
      least = dot(gap, gap);
      nearest = gap;
    }
  }
  return nearest;
}

} // namespace RectifiedTransport
