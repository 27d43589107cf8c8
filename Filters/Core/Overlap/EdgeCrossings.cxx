// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/EdgeCrossings.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// Where two edges cross that lie on each other. By the symbolic perturbation, the point of the
// smallest number moves by far the most, so that the edges are apart except for the other end of
// its edge, which is the crossing.
const Point<2>& endCrossed(const Rings& rings, const EdgePair& pair)
{
  const std::array<std::int64_t, 4> ends{ pair.First, rings.Next(pair.First), pair.Second,
    rings.Next(pair.Second) };
  const auto smallest =
    static_cast<std::size_t>(std::min_element(ends.begin(), ends.end()) - ends.begin());
  return rings.At(ends[smallest ^ 1U]);
}

// The point where two edges ab and cd cross, the same for both. With the signed areas s_c = (a, b,
// c) and s_d = (a, b, d), it is c + s_c / (s_c - s_d) (d - c). Its error must be as small as
// rounding, also for edges that are nearly parallel: else three edges that nearly lie on each other
// cross in an order in which no three lines cross, and what is left and right of their pieces does
// not agree.
Point<2> crossingOf(const Rings& rings, const EdgePair& pair)
{
  const Point<2>& a = rings.At(pair.First);
  const Point<2>& b = rings.At(rings.Next(pair.First));
  const Point<2>& c = rings.At(pair.Second);
  const Point<2>& d = rings.At(rings.Next(pair.Second));
  double errorBefore = 0.0;
  double errorAfter = 0.0;
  // Signed areas of c and d to the edge ab: they have different signs at a crossing.
  double before = doubleArea(a, b, c, errorBefore);
  double after = doubleArea(a, b, d, errorAfter);
  // Where the errors of the areas are more than this part of their difference, exact arithmetic
  // takes their place.
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  if (!(errorBefore + errorAfter < rounding * std::abs(before - after)))
  {
    before = exactDoubleArea(a, b, c);
    after = exactDoubleArea(a, b, d);
    if (before == after)
    {
      return endCrossed(rings, pair);
    }
  }
  const double part = before / (before - after);
  Point<2> x;
  // The point is in the bounds of both edges, whatever rounding does.
  for (int axis = 0; axis < 2; ++axis)
  {
    const double low = std::max(std::min(a[axis], b[axis]), std::min(c[axis], d[axis]));
    const double high = std::min(std::max(a[axis], b[axis]), std::max(c[axis], d[axis]));
    const double along = c[axis] + part * (d[axis] - c[axis]);
    x[axis] = std::isfinite(along) ? std::min(std::max(along, low), high) : 0.5 * (low + high);
  }
  return x;
}

// The crossing as a point of one of its edges; `Along` is the projection on the edge, which sorts.
EdgeCrossing crossingOn(
  const Rings& rings, std::int64_t edge, std::int64_t other, const Point<2>& x)
{
  const Point<2>& a = rings.At(edge);
  const Point<2>& b = rings.At(rings.Next(edge));
  const double along = (x[0] - a[0]) * (b[0] - a[0]) + (x[1] - a[1]) * (b[1] - a[1]);
  return { edge, along, other, x };
}

} // namespace

std::vector<EdgeCrossing> edgeCrossings(
  const Rings& rings, Progress& progress, bool& areSimple, bool atEnds)
{
  // So few edges are compared sooner than swept.
  constexpr std::int64_t few = 64; // compared sooner than swept
  // The sweep only says whether edges cross. Mostly they do not, and no search is needed.
  areSimple = areSimple || (rings.Edges() > few && !haveCrossings(rings, progress));
  std::vector<EdgeCrossing> crossings;
  if (areSimple)
  {
    areSimple = !progress.ShouldStop(); // which ends the search, too
    return crossings;
  }
  for (const EdgePair& pair : findCrossings(rings, progress, atEnds))
  {
    const Point<2> x = crossingOf(rings, pair);
    crossings.push_back(crossingOn(rings, pair.First, pair.Second, x));
    crossings.push_back(crossingOn(rings, pair.Second, pair.First, x));
  }
  std::sort(crossings.begin(), crossings.end(), [](const EdgeCrossing& p, const EdgeCrossing& q) {
    return p.Edge != q.Edge ? p.Edge < q.Edge
      : p.Along != q.Along  ? p.Along < q.Along
                            : p.Other < q.Other;
  });
  return crossings;
}

} // namespace RectifiedTransport
