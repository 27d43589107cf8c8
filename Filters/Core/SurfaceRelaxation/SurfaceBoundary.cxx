// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SurfaceRelaxation/SurfaceBoundary.h"

#include "Core/Geometry/BoxTree.h"
#include "Core/Mesh/SurfaceEdges.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t sidesOfLeaf = 16;

} // namespace

SurfaceBoundary::SurfaceBoundary(const WalkedSurface& surface, Progress& progress)
  : Surface(surface)
{
  // Counted first, so that the memory is what they need.
  const auto forSides = [&](const auto& visit) {
    for (std::int64_t triangle = 0; triangle < surface.NumberOfTriangles(); ++triangle)
    {
      for (std::int64_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
      {
        if (surface.Across(side) == WalkedSurface::Boundary && surface.Area(triangle) > 0.0)
        {
          visit(side);
        }
      }
      progress.Add(1);
    }
  };
  std::size_t count = 0;
  forSides([&](std::int64_t) { ++count; });
  this->Sides.reserve(count);
  forSides([&](std::int64_t side) { this->Sides.push_back(side); });
  if (this->Sides.empty())
  {
    return;
  }
  this->Boxes = makeBoxTree<ItemBox>(
    static_cast<std::int64_t>(this->Sides.size()),
    [&](std::int64_t first, std::int64_t last) {
      ItemBox box{ {}, first, last, -1 };
      for (std::int64_t i = first; i < last; ++i)
      {
        std::int64_t side = this->Sides[static_cast<std::size_t>(i)];
        for (int end = 0; end < 2; ++end, side = nextSide(side))
        {
          box.Add(surface.Corner(side / 3, side % 3).data());
        }
      }
      progress.Add(last - first);
      return box;
    },
    [&](const ItemBox& box) {
      return divideItems(
        this->Sides.data(), box, sidesOfLeaf,
        [this](std::int64_t side, std::size_t axis) { return this->Middle(side, axis); }, progress);
    });
}

double SurfaceBoundary::MemoryFor(double sides)
{
  // Leaves are half full or more, about; the vector of boxes doubles as it grows.
  return sides * (sizeof(std::int64_t) + 3.0 * 2.0 * sizeof(ItemBox) / (0.5 * sidesOfLeaf));
}

double SurfaceBoundary::Middle(std::int64_t side, std::size_t axis) const
{
  return 0.5 *
    (this->Surface.Corner(side / 3, side % 3)[axis] +
      this->Surface.Corner(side / 3, nextSide(side) % 3)[axis]);
}

void SurfaceBoundary::FindNear(
  const DotBox& box, double distance, std::vector<std::int64_t>& found) const
{
  found.clear();
  if (this->Boxes.empty())
  {
    return;
  }
  std::vector<std::int64_t> stack{ 0 };
  while (!stack.empty())
  {
    const std::int64_t at = stack.back();
    stack.pop_back();
    const ItemBox& part = this->Boxes[static_cast<std::size_t>(at)];
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double gap =
        std::max({ part.Low[axis] - box.High[axis], box.Low[axis] - part.High[axis], 0.0 });
      squared += gap * gap;
    }
    if (!(squared < distance * distance))
    {
      continue;
    }
    if (part.Second >= 0)
    {
      stack.push_back(part.Second);
      stack.push_back(at + 1);
      continue;
    }
    found.insert(found.end(), this->Sides.begin() + static_cast<std::ptrdiff_t>(part.First),
      this->Sides.begin() + static_cast<std::ptrdiff_t>(part.Last));
  }
}

Point<3> SurfaceBoundary::FromNearest(
  const std::vector<std::int64_t>& sides, const Point<3>& x) const
{
  double least = std::numeric_limits<double>::infinity();
  Point<3> nearest{ least, least, least };
  for (const std::int64_t side : sides)
  {
    const Point<3> from = x - this->Surface.Corner(side / 3, side % 3);
    const Point<3> edge =
      this->Surface.Corner(side / 3, nextSide(side) % 3) - this->Surface.Corner(side / 3, side % 3);
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
