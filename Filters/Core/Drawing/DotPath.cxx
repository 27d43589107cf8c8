// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Drawing/DotPath.h"

#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Trees/ItemTree.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

namespace
{

using Index = std::int32_t; // twice as many of the tables fit into the cache
constexpr int neighbours = 8;
constexpr int longest = 3; // points that a move takes along

std::size_t at(Index i)
{
  return static_cast<std::size_t>(i);
}

// The place of a cell along the Hilbert curve of a square of 2^order cells a side.
std::uint64_t hilbertPlace(std::uint32_t x, std::uint32_t y, int order)
{
  std::uint64_t place = 0;
  for (std::uint32_t side = std::uint32_t{ 1 } << (order - 1); side > 0; side /= 2)
  {
    const std::uint32_t right = (x & side) != 0 ? 1 : 0;
    const std::uint32_t up = (y & side) != 0 ? 1 : 0;
    place += std::uint64_t{ side } * side * ((3 * right) ^ up);
    // The curve in a quarter is turned.
    if (up == 0)
    {
      if (right == 1)
      {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

class DotTour
{
public:
  DotTour(ConstPointSpan<2> points, Progress& progress)
    : Points(points)
    , Count(static_cast<Index>(points.size()))
    , Tour(at(this->Count))
    , Place(at(this->Count))
    , Near(at(this->Count) * neighbours, -1)
  {
    this->Begin();
    progress.Check();
    this->FindNeighbours(progress);
    progress.Check();
  }

  void Improve(Progress& progress)
  {
    // Points whose surroundings changed, in a ring: each is there at most once.
    std::vector<Index> queue(this->Tour);
    std::vector<char> waits(at(this->Count), 1);
    std::size_t next = 0;
    for (Index waiting = this->Count; waiting > 0;)
    {
      const Index point = queue[next];
      waits[at(point)] = 0;
      --waiting;
      this->Changed.clear();
      const bool isBetter = this->ImproveAt(point);
      if (isBetter)
      {
        this->Changed.push_back(point);
      }
      // The slot of `point` is free, and so are those of all that do not wait.
      next = (next + 1) % queue.size();
      for (const Index changed : this->Changed)
      {
        if (!waits[at(changed)])
        {
          waits[at(changed)] = 1;
          queue[(next + at(waiting)) % queue.size()] = changed;
          ++waiting;
        }
      }
      if ((++this->Visits & 0xfff) == 0)
      {
        progress.Check();
      }
    }
  }

  // From behind the longest edge of the round tour.
  std::vector<std::int64_t> Path() const
  {
    Index begin = 0;
    double widest = -1.0;
    for (Index i = 0; i < this->Count; ++i)
    {
      const double length = this->Length(this->Tour[at(this->Behind(i))], this->Tour[at(i)]);
      if (length > widest)
      {
        widest = length;
        begin = i;
      }
    }
    std::vector<std::int64_t> path;
    path.reserve(this->Tour.size());
    for (Index i = 0; i < this->Count; ++i)
    {
      path.push_back(this->Tour[at((begin + i) % this->Count)]);
    }
    return path;
  }

private:
  double Length(Index a, Index b) const
  {
    const double x = this->Points[a][0] - this->Points[b][0];
    const double y = this->Points[a][1] - this->Points[b][1];
    return std::sqrt(x * x + y * y);
  }
  Index Ahead(Index place) const { return place + 1 == this->Count ? 0 : place + 1; }
  Index Behind(Index place) const { return place == 0 ? this->Count - 1 : place - 1; }
  Index Next(Index point) const { return this->Tour[at(this->Ahead(this->Place[at(point)]))]; }
  Index Previous(Index point) const { return this->Tour[at(this->Behind(this->Place[at(point)]))]; }

  void Put(Index place, Index point)
  {
    this->Tour[at(place)] = point;
    this->Place[at(point)] = place;
  }

  // Along a Hilbert curve.
  void Begin()
  {
    constexpr int order = 16;
    Bounds<2> bounds;
    for (Index i = 0; i < this->Count; ++i)
    {
      bounds.Add(this->Points[i]);
    }
    const double side = bounds.LongestSide();
    const double scale = side > 0.0 ? ((1 << order) - 1) / side : 0.0;
    std::vector<std::uint64_t> keys(at(this->Count));
    for (Index i = 0; i < this->Count; ++i)
    {
      const auto cell = [&](std::size_t axis) {
        return static_cast<std::uint32_t>(scale * (this->Points[i][axis] - bounds.Low[axis]));
      };
      keys[at(i)] = hilbertPlace(cell(0), cell(1), order);
    }
    std::iota(this->Tour.begin(), this->Tour.end(), Index{ 0 });
    std::stable_sort(this->Tour.begin(), this->Tour.end(),
      [&keys](Index a, Index b) { return keys[at(a)] < keys[at(b)]; });
    for (Index i = 0; i < this->Count; ++i)
    {
      this->Place[at(this->Tour[at(i)])] = i;
    }
  }

  // The nearest points of each: first those beside it on the curve, then all that are nearer than
  // the farthest of those.
  void FindNeighbours(Progress& progress)
  {
    constexpr std::int64_t leaf = 8;
    std::vector<std::int64_t> items(at(this->Count));
    std::iota(items.begin(), items.end(), std::int64_t{ 0 });
    const auto coordinate = [this](std::int64_t point, std::size_t axis) {
      return axis < 2 ? this->Points[point][axis] : 0.0;
    };
    const ItemTree tree(
      std::move(items), leaf,
      [&](std::int64_t point, PointBounds& box) {
        const Point<3> place{ coordinate(point, 0), coordinate(point, 1), 0.0 };
        box.Add(place.data());
      },
      coordinate, progress);
    const int count = std::min<int>(neighbours, this->Count - 1);
    std::vector<std::pair<double, Index>> found;
    for (Index i = 0; i < this->Count; ++i)
    {
      found.clear();
      Index ahead = this->Place[at(i)];
      Index behind = ahead;
      while (static_cast<int>(found.size()) < count)
      {
        ahead = this->Ahead(ahead);
        this->AddNeighbour(i, this->Tour[at(ahead)], found);
        behind = this->Behind(behind);
        this->AddNeighbour(i, this->Tour[at(behind)], found);
      }
      std::sort(found.begin(), found.end());
      found.resize(static_cast<std::size_t>(count));
      const auto isNear = [&](const PointBounds& box) {
        double squared = 0.0;
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
          const double x = coordinate(i, axis);
          const double gap = std::max({ box.Low[axis] - x, x - box.High[axis], 0.0 });
          squared += gap * gap;
        }
        return squared < found.back().first * found.back().first;
      };
      tree.VisitNear(isNear, [&](std::int64_t item) {
        const auto other = static_cast<Index>(item);
        const std::pair<double, Index> entry(this->Length(i, other), other);
        if (other != i && entry < found.back() &&
          std::find(found.begin(), found.end(), entry) == found.end())
        {
          found.back() = entry;
          std::inplace_merge(found.begin(), found.end() - 1, found.end());
        }
      });
      for (std::size_t k = 0; k < found.size(); ++k)
      {
        this->Near[at(i) * neighbours + k] = found[k].second;
      }
    }
  }

  // Unless it is the point itself, or among them: there may be fewer than twice as many.
  void AddNeighbour(Index point, Index other, std::vector<std::pair<double, Index>>& found) const
  {
    const std::pair<double, Index> entry(this->Length(point, other), other);
    if (other != point && std::find(found.begin(), found.end(), entry) == found.end())
    {
      found.push_back(entry);
    }
  }

  // Turns the points at the places from `first` to `last` around, or all others: the same tour.
  void Reverse(Index first, Index last)
  {
    Index inner = last - first;
    inner += inner < 0 ? this->Count : 0;
    ++inner;
    if (2 * inner > this->Count)
    {
      std::swap(first, last);
      first = this->Ahead(first);
      last = this->Behind(last);
      inner = this->Count - inner;
    }
    for (Index i = 0; i < inner / 2; ++i)
    {
      const Index a = this->Tour[at(first)];
      this->Put(first, this->Tour[at(last)]);
      this->Put(last, a);
      first = this->Ahead(first);
      last = this->Behind(last);
    }
  }

  // The part of the tour between two points, of which `first` is the next to or the one before
  // `beside`.
  void ReversePath(Index beside, Index first, Index last)
  {
    this->Next(beside) == first ? this->Reverse(this->Place[at(first)], this->Place[at(last)])
                                : this->Reverse(this->Place[at(last)], this->Place[at(first)]);
  }

  bool ImproveAt(Index a) { return this->Exchange(a) || this->MoveFrom(a); }

  // Replaces the edges a-b and c-d by a-c and b-d: the points between are turned around.
  bool Exchange(Index a)
  {
    for (const bool isAhead : { true, false })
    {
      const Index b = isAhead ? this->Next(a) : this->Previous(a);
      const double old = this->Length(a, b);
      for (int k = 0; k < neighbours; ++k)
      {
        const Index c = this->Near[at(a) * neighbours + static_cast<std::size_t>(k)];
        if (c < 0)
        {
          break;
        }
        const double gain = old - this->Length(a, c);
        if (!(gain > 0.0))
        {
          break;
        }
        const Index d = isAhead ? this->Next(c) : this->Previous(c);
        if (c == b || d == a ||
          !(gain + this->Length(c, d) - this->Length(b, d) > this->Least(old)))
        {
          continue;
        }
        isAhead ? this->Reverse(this->Place[at(b)], this->Place[at(c)])
                : this->Reverse(this->Place[at(c)], this->Place[at(b)]);
        this->Changed = { b, c, d };
        return true;
      }
    }
    return false;
  }

  // Moves up to three points, of which `a` is an end, beside a neighbour of `a`.
  bool MoveFrom(Index a)
  {
    for (const bool isAhead : { true, false })
    {
      const Index p = isAhead ? this->Previous(a) : this->Next(a);
      const double old = this->Length(p, a);
      Index end = a;
      for (int count = 1; count <= longest && count + 2 < this->Count; ++count)
      {
        end = count == 1 ? a : (isAhead ? this->Next(end) : this->Previous(end));
        const Index n = isAhead ? this->Next(end) : this->Previous(end);
        const double taken = this->Length(end, n) - this->Length(p, n);
        for (int k = 0; k < neighbours; ++k)
        {
          const Index c = this->Near[at(a) * neighbours + static_cast<std::size_t>(k)];
          if (c < 0)
          {
            break;
          }
          const double gain = old - this->Length(a, c);
          if (!(gain > 0.0))
          {
            break;
          }
          if (this->IsAmong(c, a, count, isAhead))
          {
            continue;
          }
          for (const bool isBefore : { true, false })
          {
            const Index e = isBefore ? this->Next(c) : this->Previous(c);
            if (this->IsAmong(e, a, count, isAhead) ||
              !(gain + taken + this->Length(c, e) - this->Length(end, e) > this->Least(old)))
            {
              continue;
            }
            // From p [a ... end] n ... u v, with u and v in place of c and e, to p n ... u [ ] v.
            const Index u = isAhead == isBefore ? c : e;
            this->ReversePath(p, a, u);
            this->ReversePath(p, u, n);
            if (u == c)
            {
              this->ReversePath(c, end, a);
            }
            this->Changed = { p, n, c, e, end };
            return true;
          }
        }
      }
    }
    return false;
  }

  bool IsAmong(Index point, Index a, int count, bool isAhead) const
  {
    Index distance = isAhead ? this->Place[at(point)] - this->Place[at(a)]
                             : this->Place[at(a)] - this->Place[at(point)];
    distance += distance < 0 ? this->Count : 0;
    return distance < count;
  }

  // What rounding may feign.
  static double Least(double length) { return 1e-12 * length; }

  ConstPointSpan<2> Points;
  Index Count;
  std::vector<Index> Tour;  // by places
  std::vector<Index> Place; // by points
  std::vector<Index> Near;  // by points, nearest first; -1 for none
  std::vector<Index> Changed;
  std::int64_t Visits = 0;
};

} // namespace

std::vector<std::int64_t> shortPath(ConstPointSpan<2> points, const Context& context)
{
  std::vector<std::int64_t> path(static_cast<std::size_t>(points.size()));
  std::iota(path.begin(), path.end(), std::int64_t{ 0 });
  // A tour needs two edges to exchange; and half the largest index stands for no data at all.
  constexpr std::int64_t fewest = 5;
  constexpr std::int64_t most = std::int64_t{ 1 } << 30;
  if (points.size() < fewest || points.size() > most)
  {
    return path;
  }
  Progress progress(context);
  DotTour tour(points, progress);
  tour.Improve(progress);
  progress.EndSlice(1);
  return tour.Path();
}

} // namespace RectifiedTransport
