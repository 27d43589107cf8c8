// SPDX-License-Identifier: BSD-3-Clause
// The sides of triangles, grouped by edges.
#ifndef RectifiedTransport_EdgeSides_h
#define RectifiedTransport_EdgeSides_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/SurfaceEdges.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// Calls visit(sides, count) for each edge of triangles, on any thread: its sides ascend.
// pointOf(corner) is the point of corner i of triangle t, with the number 3t+i. Triangles that
// isLeftOut(triangle) have no sides; the others have three different points. The sides are sorted
// by their ends, in O(sides log sides) for any valence of the points. Memory: 8 bytes a side and 8
// a point. Throws std::bad_alloc and Cancelled.
template <class PointOf, class IsLeftOut, class Visit>
void visitEdges(std::int64_t triangles, std::int64_t points, const PointOf& pointOf,
  const IsLeftOut& isLeftOut, Progress& progress, const Visit& visit)
{
  const auto lowOf = [&](std::int64_t side) {
    return std::min(pointOf(side), pointOf(nextSide(side)));
  };
  const auto highOf = [&](std::int64_t side) {
    return std::max(pointOf(side), pointOf(nextSide(side)));
  };
  // Triangles in a range, and in the first slice, which takes some milliseconds: access is
  // scattered.
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  constexpr std::int64_t units = std::int64_t{ 1 } << 16;
  Stages stages(progress, { { "counts", 2 }, { "lists", 3 }, { "edges", 5 } });
  const auto forSides = [&](Progress& stage, const auto& visitSide) {
    stage.ForEachInOrder(
      triangles, grain,
      [&](std::int64_t triangle) {
        if (!isLeftOut(triangle))
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
  LargeBuffer<std::int64_t> firstMemory(points + 2, 0);
  LargeBuffer<std::int64_t> sidesMemory(3 * triangles);
  std::int64_t* first = firstMemory.data();
  std::int64_t* sides = sidesMemory.data();
  forSides(stages["counts"], [&](std::int64_t side) { ++first[lowOf(side) + 2]; });
  for (std::int64_t point = 1; point < points + 2; ++point)
  {
    first[point] += first[point - 1];
  }
  forSides(stages["lists"], [&](std::int64_t side) { sides[first[lowOf(side) + 1]++] = side; });
  stages["edges"].ForEach(
    points, 2 * grain,
    [&](std::int64_t point) {
      // The sides whose lower end is this point; sorted by their other ends, edges are runs.
      std::int64_t* next = sides + first[point];
      std::int64_t* const last = sides + first[point + 1];
      std::sort(next, last, [&](std::int64_t a, std::int64_t b) {
        const std::int64_t highA = highOf(a);
        const std::int64_t highB = highOf(b);
        return highA != highB ? highA < highB : a < b;
      });
      while (next < last)
      {
        const std::int64_t* edge = next;
        const std::int64_t other = highOf(*edge);
        while (next < last && highOf(*next) == other)
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
