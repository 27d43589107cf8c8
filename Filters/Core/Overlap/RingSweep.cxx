// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/RingCrossings.h"

#include "Core/Overlap/EdgeOrder.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The algorithm of Shamos and Hoey: a horizontal line passes the points from below. It keeps the
// edges that it meets in order; two edges cross only if they become neighbours first, so that new
// neighbours are tested.
class Sweep
{
public:
  explicit Sweep(const Rings& rings)
    : All(rings)
  {
    const auto count = static_cast<std::size_t>(rings.Edges());
    this->Before.resize(count);
    this->Upward.resize(count);
    for (std::int32_t i = 0; i < rings.Edges(); ++i)
    {
      const NumberedPoint a = rings.Numbered(i);
      const NumberedPoint b = rings.Numbered(rings.Next(i));
      // By the perturbed order, so that horizontal edges have a lower end, too.
      this->Upward[static_cast<std::size_t>(i)] =
        isAbove(a, b) ? Ends{ b.X, a.X } : Ends{ a.X, b.X };
      this->Before[static_cast<std::size_t>(rings.Next(i))] = i;
    }
  }

  // Returns whether there is a crossing; false if the run is to stop.
  bool Run(Progress& progress)
  {
    constexpr std::size_t betweenPolls = std::size_t{ 1 } << 14;
    const std::vector<Height> heights = this->SortedHeights(progress);
    for (std::size_t i = 0; i < heights.size(); ++i)
    {
      if (i % betweenPolls == 0 && progress.ShouldStop())
      {
        return false;
      }
      if (this->Pass(heights[i].Number))
      {
        return true;
      }
    }
    return false;
  }

private:
  struct Height
  {
    double Y;
    std::int32_t Number;
  };

  // The points from the lowest on; ties by descending numbers, as their infinitesimals have it.
  // Sorted by chunks and merges, to poll in between. Not sorted if the run is to stop.
  std::vector<Height> SortedHeights(Progress& progress) const
  {
    std::vector<Height> heights;
    heights.reserve(static_cast<std::size_t>(this->All.Edges()));
    for (std::int32_t i = 0; i < this->All.Edges(); ++i)
    {
      heights.push_back({ this->All.At(i)[1], i });
    }
    const auto isLower = [](const Height& a, const Height& b) {
      return a.Y != b.Y ? a.Y < b.Y : a.Number > b.Number;
    };
    // Chunks short enough for a poll after each.
    constexpr std::size_t sortedAtOnce = std::size_t{ 1 } << 16;
    const auto at = [&](std::size_t place) {
      return heights.begin() + static_cast<std::ptrdiff_t>(std::min(place, heights.size()));
    };
    for (std::size_t i = 0; i < heights.size() && !progress.ShouldStop(); i += sortedAtOnce)
    {
      std::sort(at(i), at(i + sortedAtOnce), isLower);
    }
    for (std::size_t width = sortedAtOnce; width < heights.size(); width *= 2)
    {
      for (std::size_t i = 0; i + width < heights.size() && !progress.ShouldStop(); i += 2 * width)
      {
        std::inplace_merge(at(i), at(i + width), at(i + 2 * width), isLower);
      }
    }
    return heights;
  }

  // The lower and the higher end of an edge.
  struct Ends
  {
    Point<2> Low;
    Point<2> High;
  };

  // By floating point where its error bound decides, else by the perturbed exact predicate.
  bool IsLeftOf(std::int32_t edge, const NumberedPoint& point) const
  {
    const Ends& ends = this->Upward[static_cast<std::size_t>(edge)];
    double error = 0.0;
    const double area = doubleArea(ends.Low, ends.High, point.X, error);
    if (std::abs(area) > error)
    {
      return area < 0.0;
    }
    NumberedPoint low = this->All.Numbered(edge);
    NumberedPoint high = this->All.Numbered(this->All.Next(edge));
    if (isAbove(low, high))
    {
      std::swap(low, high);
    }
    // An edge is left of a point that does not lie to the left of it.
    return !turnsLeft(low, high, point);
  }

  // Edges that follow each other in a ring share a point, which is no crossing.
  bool DoTwoCross(std::int32_t i, std::int32_t j) const
  {
    if (i == EdgeOrder::nothing || j == EdgeOrder::nothing || this->All.Next(i) == j ||
      this->All.Next(j) == i)
    {
      return false;
    }
    return doCross(this->All.Numbered(i), this->All.Numbered(this->All.Next(i)),
      this->All.Numbered(j), this->All.Numbered(this->All.Next(j)));
  }

  // Moves the line past a point, at which one edge of the ring ends and one begins, or both begin,
  // or both end. Returns whether there is a crossing.
  bool Pass(std::int32_t number)
  {
    const NumberedPoint point = this->All.Numbered(number);
    const std::int32_t in = this->Before[static_cast<std::size_t>(number)];
    const std::int32_t out = number;
    const bool doesInEnd = isAbove(point, this->All.Numbered(in));
    const bool doesOutEnd = isAbove(point, this->All.Numbered(this->All.Next(out)));
    // The edges of the point itself count as right of it, so that the place is theirs.
    EdgeOrder::Place place = this->Order.Find([&](std::int32_t edge) {
      if (edge == in || edge == out)
      {
        return false;
      }
      return this->IsLeftOf(edge, point);
    });
    const std::int32_t left = this->Order.Before(place);
    // Both edges begin: they are new neighbours, and of the edges beside.
    if (!doesInEnd && !doesOutEnd)
    {
      const std::int32_t right = this->Order.At(place);
      // The order of both edges just above the point.
      const bool isOutRight =
        turnsLeft(point, this->All.Numbered(this->All.Next(out)), this->All.Numbered(in));
      const std::int32_t both[2] = { isOutRight ? in : out, isOutRight ? out : in };
      this->Order.Insert(place, both, both + 2);
      return this->DoTwoCross(left, isOutRight ? in : out) ||
        this->DoTwoCross(isOutRight ? out : in, right);
    }
    const std::int32_t found = this->Order.At(place);
    if (doesInEnd && doesOutEnd)
    {
      const std::int32_t next = this->Order.After(place);
      if (!((found == in && next == out) || (found == out && next == in)))
      {
        return true; // they are in another order than where they began
      }
      place = this->Order.Erase(this->Order.Erase(place));
      return this->DoTwoCross(left, this->Order.At(place));
    }
    // The edge that ends is not where the point is: the order has changed, as edges cross.
    if (found != (doesInEnd ? in : out))
    {
      return true;
    }
    // One edge ends and the other takes its place.
    const std::int32_t begun = doesInEnd ? out : in;
    this->Order.Replace(place, begun);
    return this->DoTwoCross(left, begun) || this->DoTwoCross(begun, this->Order.After(place));
  }

  const Rings& All;
  std::vector<std::int32_t> Before; // by points: the edge that ends there
  std::vector<Ends> Upward;
  // The order keeps the edges that the line meets, from left to right.
  EdgeOrder Order;
};

} // namespace

// Three edges of one ring are neighbours, which do not cross.
bool haveCrossings(const Rings& rings, Progress& progress)
{
  return rings.Edges() > 3 && Sweep(rings).Run(progress);
}

} // namespace RectifiedTransport
