// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Solid/SurfaceEdges.h"

#include <algorithm>

namespace RectifiedTransport
{

SurfaceEdges::SurfaceEdges(const std::int64_t* triangles, std::int64_t count, std::int64_t points)
  : Triangles(triangles)
  , First(points + 2)
  , Sides(3 * count)
  , Others(3 * count)
{
  std::fill_n(this->First.data(), points + 2, std::int64_t{ 0 });
}

SurfaceEdges::Ends SurfaceEdges::EndsOf(std::int64_t side) const
{
  const std::int64_t from = this->Triangles[side];
  const std::int64_t to = this->Triangles[side % 3 == 2 ? side - 2 : side + 1];
  return { std::min(from, to), std::max(from, to), from < to };
}

// A counting sort. First is two ahead of the counts, so that Sort leaves it where it belongs.
void SurfaceEdges::Count(std::int64_t firstTriangle, std::int64_t lastTriangle)
{
  for (std::int64_t side = 3 * firstTriangle; side < 3 * lastTriangle; ++side)
  {
    ++this->First.data()[this->EndsOf(side).Low + 2];
  }
}

void SurfaceEdges::Sort(std::int64_t firstTriangle, std::int64_t lastTriangle)
{
  std::int64_t* first = this->First.data();
  if (firstTriangle == 0)
  {
    for (std::int64_t point = 1; point < this->First.size(); ++point)
    {
      first[point] += first[point - 1];
    }
  }
  for (std::int64_t side = 3 * firstTriangle; side < 3 * lastTriangle; ++side)
  {
    this->Sides.data()[first[this->EndsOf(side).Low + 1]++] = side;
  }
}

void SurfaceEdges::Pair(std::int64_t firstPoint, std::int64_t lastPoint)
{
  const std::int64_t* first = this->First.data();
  for (std::int64_t point = firstPoint; point < lastPoint; ++point)
  {
    std::int64_t* begin = this->Sides.data() + first[point];
    std::int64_t* end = this->Sides.data() + first[point + 1];
    std::sort(begin, end, [this](std::int64_t a, std::int64_t b) {
      const std::int64_t highA = this->EndsOf(a).High;
      const std::int64_t highB = this->EndsOf(b).High;
      return highA != highB ? highA < highB : a < b;
    });
    while (begin < end)
    {
      const std::int64_t high = this->EndsOf(*begin).High;
      const std::int64_t* group = begin;
      while (begin < end && this->EndsOf(*begin).High == high)
      {
        ++begin;
      }
      this->PairGroup(group, begin - group);
    }
  }
}

void SurfaceEdges::PairGroup(const std::int64_t* sides, std::int64_t count)
{
  if (count == 2)
  {
    this->Others.data()[sides[0]] = sides[1];
    this->Others.data()[sides[1]] = sides[0];
    this->NumberReversed += this->EndsOf(sides[0]).Up == this->EndsOf(sides[1]).Up ? 1 : 0;
    return;
  }
  ++(count == 1 ? this->NumberOpen : this->NumberNonManifold);
}

} // namespace RectifiedTransport
