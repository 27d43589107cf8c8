// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/SurfaceEdges.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// Sides in a range, and in the first slice, which takes some milliseconds: access is scattered.
constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
constexpr std::int64_t units = std::int64_t{ 1 } << 17;

struct Ends
{
  std::int64_t Low;
  std::int64_t High;
  bool Up; // from low to high
};

Ends endsOf(const std::int64_t* triangles, std::int64_t side)
{
  const std::int64_t from = triangles[side];
  const std::int64_t to = triangles[nextSide(side)];
  return { std::min(from, to), std::max(from, to), from < to };
}

} // namespace

SurfaceEdges::SurfaceEdges(const TriangleSurface& surface, const Context& context)
  : Others(3 * surface.NumberOfTriangles)
{
  const std::int64_t count = this->Others.size();
  const std::int64_t points = surface.Points.size();
  const std::int64_t* triangles = surface.Triangles;
  Progress progress(context);

  // A counting sort by the lower ends. Counts are stored at the point + 2: summed, first[point + 1]
  // is where a point's sides begin, and after they have been placed first[point] is.
  LargeBuffer<std::int64_t> firstMemory(points + 2);
  LargeBuffer<std::int64_t> sidesMemory(count);
  std::int64_t* first = firstMemory.data();
  std::int64_t* sides = sidesMemory.data();
  std::fill_n(first, points + 2, std::int64_t{ 0 });
  progress.BeginStage(0.2);
  progress.ForInOrder(
    count, grain,
    [=](std::int64_t begin, std::int64_t end) {
      for (std::int64_t side = begin; side < end; ++side)
      {
        ++first[endsOf(triangles, side).Low + 2];
      }
    },
    units);
  for (std::int64_t point = 1; point < points + 2; ++point)
  {
    first[point] += first[point - 1];
  }
  progress.BeginStage(0.5);
  progress.ForInOrder(
    count, grain,
    [=](std::int64_t begin, std::int64_t end) {
      for (std::int64_t side = begin; side < end; ++side)
      {
        sides[first[endsOf(triangles, side).Low + 1]++] = side;
      }
    },
    units);
  progress.BeginStage(1.0);
  progress.For(
    points, grain,
    [=](std::int64_t begin, std::int64_t end) {
      for (std::int64_t point = begin; point < end; ++point)
      {
        this->Pair(triangles, sides + first[point], sides + first[point + 1]);
      }
    },
    2 * grain);
}

// Pairs the sides [begin, end) of one lower end by their upper ends.
void SurfaceEdges::Pair(const std::int64_t* triangles, std::int64_t* begin, std::int64_t* end)
{
  std::sort(begin, end, [triangles](std::int64_t a, std::int64_t b) {
    const std::int64_t highA = endsOf(triangles, a).High;
    const std::int64_t highB = endsOf(triangles, b).High;
    return highA != highB ? highA < highB : a < b;
  });
  while (begin < end)
  {
    const std::int64_t* edge = begin;
    const std::int64_t high = endsOf(triangles, *edge).High;
    while (begin < end && endsOf(triangles, *begin).High == high)
    {
      ++begin;
    }
    if (begin - edge != 2)
    {
      ++(begin - edge == 1 ? this->NumberOpen : this->NumberNonManifold);
      this->NumberOdd += begin - edge > 2 && (begin - edge) % 2 == 1 ? 1 : 0;
      for (; edge < begin; ++edge)
      {
        this->Others.data()[*edge] = -1;
      }
      continue;
    }
    this->Others.data()[edge[0]] = edge[1];
    this->Others.data()[edge[1]] = edge[0];
    this->NumberReversed += endsOf(triangles, edge[0]).Up == endsOf(triangles, edge[1]).Up ? 1 : 0;
  }
}

} // namespace RectifiedTransport
