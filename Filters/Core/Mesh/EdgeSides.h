// SPDX-License-Identifier: BSD-3-Clause
// The sides of triangles by the edges that they are.
#ifndef RectifiedTransport_EdgeSides_h
#define RectifiedTransport_EdgeSides_h

#include "Core/Mesh/SurfaceEdges.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// Triangles whose corners are points. pointOf(corner) is the point of corner i of triangle t, with
// the number 3t+i. Those that isLeftOut(triangle) have no sides; the others have three different
// points.
template <class PointOf, class IsLeftOut>
struct SideCorners
{
  std::int64_t NumberOfTriangles;
  std::int64_t NumberOfPoints;
  PointOf Of;
  IsLeftOut LeftOut;

  std::int64_t Low(std::int64_t side) const
  {
    return std::min(this->Of(side), this->Of(nextSide(side)));
  }
  std::int64_t High(std::int64_t side) const
  {
    return std::max(this->Of(side), this->Of(nextSide(side)));
  }
};
template <class PointOf, class IsLeftOut>
SideCorners(std::int64_t, std::int64_t, PointOf, IsLeftOut) -> SideCorners<PointOf, IsLeftOut>;

// Calls visit(sides, count) for each edge, on any thread: its sides ascend. The sides are sorted by
// their ends, in O(sides log sides) for any valence of the points. Memory: 8 bytes a side and 8 a
// point. Throws std::bad_alloc and Cancelled.
template <class PointOf, class IsLeftOut, class Visit>
void visitEdges(
  const SideCorners<PointOf, IsLeftOut>& corners, Progress& progress, const Visit& visit)
{
  // Triangles in a range, and in the first slice, which takes some milliseconds: access is
  // scattered.
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  constexpr std::int64_t units = std::int64_t{ 1 } << 16;
  Stages stages(progress, { { "counts", 2 }, { "lists", 3 }, { "edges", 5 } });
  const auto forSides = [&](Progress& stage, const auto& visitSide) {
    stage.ForEachInOrder(
      corners.NumberOfTriangles, grain,
      [&](std::int64_t triangle) {
        if (!corners.LeftOut(triangle))
        {
          visitSide(3 * triangle);
          visitSide(3 * triangle + 1);
          visitSide(3 * triangle + 2);
        }
      },
      units);
  };
  // A counting sort by the lower ends. Counts are stored at the point + 2: summed, first[point + 1]
  // is where a point's sides begin, and after they have been placed first[point] is.
  const std::int64_t points = corners.NumberOfPoints;
  LargeBuffer<std::int64_t> firstMemory(points + 2);
  LargeBuffer<std::int64_t> sidesMemory(3 * corners.NumberOfTriangles);
  std::int64_t* first = firstMemory.data();
  std::int64_t* sides = sidesMemory.data();
  std::fill_n(first, points + 2, std::int64_t{ 0 });
  forSides(stages["counts"], [&](std::int64_t side) { ++first[corners.Low(side) + 2]; });
  for (std::int64_t point = 1; point < points + 2; ++point)
  {
    first[point] += first[point - 1];
  }
  forSides(
    stages["lists"], [&](std::int64_t side) { sides[first[corners.Low(side) + 1]++] = side; });
  stages["edges"].ForEach(
    points, 2 * grain,
    [&](std::int64_t point) {
      std::int64_t* next = sides + first[point];
      std::int64_t* const last = sides + first[point + 1];
      std::sort(next, last, [&](std::int64_t a, std::int64_t b) {
        const std::int64_t highA = corners.High(a);
        const std::int64_t highB = corners.High(b);
        return highA != highB ? highA < highB : a < b;
      });
      while (next < last)
      {
        const std::int64_t* edge = next;
        const std::int64_t other = corners.High(*edge);
        while (next < last && corners.High(*next) == other)
        {
          ++next;
        }
        visit(edge, next - edge);
      }
    },
    4 * grain);
}

} // namespace RectifiedTransport

#endif
