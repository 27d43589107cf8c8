// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/RegionMap.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace RectifiedTransport
{

namespace
{

// An edge by the numbers of its ends, for a hash table of divided edges.
struct Edge
{
  std::int64_t Low;
  std::int64_t High;
  bool operator==(const Edge& other) const
  {
    return this->Low == other.Low && this->High == other.High;
  }
};

struct EdgeHash
{
  std::size_t operator()(const Edge& edge) const
  {
    // The odd number nearest to 2^64 divided by the golden ratio (Fibonacci hashing).
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15u;
    const auto low = static_cast<std::uint64_t>(edge.Low);
    const auto high = static_cast<std::uint64_t>(edge.High);
    return static_cast<std::size_t>((low * odd ^ high) * odd);
  }
};

} // namespace

// Returns the number of the new point, by which rings refer to it.
std::int64_t RegionMap::AddPoint(const Point<2>& place)
{
  this->Places.push_back(place);
  return static_cast<std::int64_t>(this->Places.size()) - 1;
}

void RegionMap::AddRing(std::int32_t region, const std::vector<std::int64_t>& points)
{
  this->Corners.insert(this->Corners.end(), points.begin(), points.end());
  this->Begins.push_back(static_cast<std::int64_t>(this->Corners.size()));
  this->Regions.push_back(region);
  this->Holes.push_back(0);
  this->Turned.push_back(0);
}

// Shoelace formula, relative to the ring's first point, so that maps far from the origin lose no
// digits.
double RegionMap::WindingArea(std::int64_t ring) const
{
  const std::int64_t begin = this->Begins[Index(ring)];
  const std::int64_t end = this->Begins[Index(ring) + 1];
  if (begin == end)
  {
    return 0.0;
  }
  const Point<2>& origin = this->Places[Index(this->Corners[Index(begin)])];
  double sum = 0.0;
  for (std::int64_t i = begin + 1; i + 1 < end; ++i)
  {
    const Point<2>& a = this->Places[Index(this->Corners[Index(i)])];
    const Point<2>& b = this->Places[Index(this->Corners[Index(i + 1)])];
    sum += (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
  }
  return 0.5 * sum;
}

// A ring that runs clockwise in the given map is turned: its area is positive until it folds. Holes
// have positive areas, which are subtracted from their region.
double RegionMap::AreaOf(std::int64_t ring) const
{
  const auto crossed = this->Crossed.find(this->RegionOf(ring));
  if (this->IsOpen(ring) || crossed != this->Crossed.end())
  {
    // If rings of a region cross, only their common area is defined; the first ring has it.
    const bool isFirst = crossed != this->Crossed.end() && crossed->second.front() == ring;
    return isFirst ? this->CrossedArea(crossed->second) : 0.0;
  }
  const double area = this->WindingArea(ring);
  return (this->Turned[Index(ring)] != 0) != this->IsHole(ring) ? -area : area;
}

// Sums up the rings of each region; lines have no area, and holes count negatively.
std::vector<double> RegionMap::Areas(std::int32_t regions) const
{
  std::vector<double> areas(static_cast<std::size_t>(regions), 0.0);
  for (std::int64_t ring = 0; ring < this->Rings(); ++ring)
  {
    if (this->IsOpen(ring))
    {
      continue;
    }
    const double area = this->AreaOf(ring);
    areas[Index(this->RegionOf(ring))] += this->IsHole(ring) ? -area : area;
  }
  return areas;
}

// The rings of a region are in the order of their numbers; a region without rings has none.
std::vector<std::vector<std::int64_t>> RegionMap::RingsOfRegions() const
{
  std::vector<std::vector<std::int64_t>> rings;
  for (std::int64_t ring = 0; ring < this->Rings(); ++ring)
  {
    if (this->IsOpen(ring))
    {
      continue;
    }
    rings.resize(std::max(rings.size(), Index(this->RegionOf(ring)) + 1));
    rings[Index(this->RegionOf(ring))].push_back(ring);
  }
  return rings;
}

// A ring that is inside an odd number of other rings of its region is a hole. This requires no
// order of the rings and no direction.
std::vector<DividingPoint> RegionMap::FindHoles(const Context& context)
{
  Progress progress(context);
  progress.Expect(4 * this->Edges());
  EdgeParts parts;
  std::vector<RingShape> shapes;
  for (std::int64_t ring = 0; ring < this->Rings(); ++ring)
  {
    shapes.push_back(this->ShapeOf(ring));
    progress.Add(this->CountOf(ring));
  }
  // Rings of different regions do not matter to each other.
  for (std::vector<std::int64_t>& rings : this->RingsOfRegions())
  {
    // Sorted by their lower ends along x, candidates for the inside of a ring are contiguous.
    std::sort(rings.begin(), rings.end(), [&](std::int64_t a, std::int64_t b) {
      return shapes[Index(a)].Low[0] < shapes[Index(b)].Low[0];
    });
    // How many other rings of the region each ring lies in.
    std::vector<int> around(rings.size(), 0);
    for (const std::int64_t outer : rings)
    {
      this->CountAround(outer, rings, shapes, around, progress);
    }
    for (std::size_t i = 0; i < rings.size(); ++i)
    {
      const std::size_t ring = Index(rings[i]);
      this->Holes[ring] = around[i] % 2 == 1;
      // An outer ring should run anticlockwise and a hole clockwise; others are turned.
      this->Turned[ring] = (this->WindingArea(rings[i]) < 0.0) != this->IsHole(rings[i]);
    }
    this->FindParts(rings, parts, progress);
  }
  return parts.empty() ? std::vector<DividingPoint>() : this->DivideAtCrossings(parts, progress);
}

// Computes the bounds of a ring and the middles of up to 5 of its edges, evenly spaced, for a
// majority vote on what is inside.
RegionMap::RingShape RegionMap::ShapeOf(std::int64_t ring) const
{
  RingShape shape{ { HUGE_VAL, HUGE_VAL }, { -HUGE_VAL, -HUGE_VAL }, {} };
  const std::int64_t count = this->CountOf(ring);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const Point<2>& place = this->Places[Index(this->CornerOf(ring, i))];
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      shape.Low[axis] = std::min(shape.Low[axis], place[axis]);
      shape.High[axis] = std::max(shape.High[axis], place[axis]);
    }
  }
  constexpr std::int64_t most = 5;
  const std::int64_t tries = std::min(most, count);
  for (std::int64_t i = 0; i < tries; ++i)
  {
    const std::int64_t corner = i * count / tries;
    const Point<2>& a = this->Places[Index(this->CornerOf(ring, corner))];
    const Point<2>& b = this->Places[Index(this->CornerOf(ring, (corner + 1) % count))];
    shape.Middles.push_back({ 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) });
  }
  return shape;
}

// Adds 1 to `around` for each ring that lies in the ring `outer`; `rings` ascend by their lower
// ends along x. A middle is inside if the ray from it along x crosses an odd number of edges
// (even-odd rule). The middles are sorted by y, so that an edge visits only those at its heights.
void RegionMap::CountAround(std::int64_t outer, const std::vector<std::int64_t>& rings,
  const std::vector<RingShape>& shapes, std::vector<int>& around, Progress& progress) const
{
  struct Middle
  {
    Point<2> Place;
    std::size_t Ring; // index among the rings
    bool IsInside;
  };
  // Only rings whose bounds are within those of the outer ring can lie in it.
  const RingShape& shape = shapes[Index(outer)];
  // The middles of edges of all rings that may be inside.
  std::vector<Middle> middles;
  const auto first = std::lower_bound(rings.begin(), rings.end(), shape.Low[0],
    [&](std::int64_t ring, double low) { return shapes[Index(ring)].Low[0] < low; });
  for (auto ring = first; ring != rings.end() && shapes[Index(*ring)].Low[0] <= shape.High[0];
       ++ring)
  {
    progress.Add(1);
    const RingShape& inner = shapes[Index(*ring)];
    for (const Point<2>& middle : inner.Middles)
    {
      if (*ring != outer && shape.Contains(inner))
      {
        middles.push_back({ middle, static_cast<std::size_t>(ring - rings.begin()), false });
      }
    }
  }
  if (middles.empty())
  {
    return;
  }
  std::sort(middles.begin(), middles.end(),
    [](const Middle& a, const Middle& b) { return a.Place[1] < b.Place[1]; });
  this->VisitCorners(outer, [&](std::int64_t, std::int64_t from, std::int64_t to) {
    const Point<2>& a = this->Places[Index(from)];
    const Point<2>& b = this->Places[Index(to)];
    // A half-open interval of heights, so that a ray through a corner crosses exactly one of its
    // edges.
    const double low = std::min(a[1], b[1]);
    const double high = std::max(a[1], b[1]);
    auto middle = std::lower_bound(middles.begin(), middles.end(), low,
      [](const Middle& one, double height) { return one.Place[1] < height; });
    progress.Add(1);
    for (; middle != middles.end() && middle->Place[1] < high; ++middle)
    {
      progress.Add(1);
      // The crossing of the edge at the middle's height; the ray goes towards larger x.
      const double x = a[0] + (middle->Place[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
      middle->IsInside = middle->IsInside != (x > middle->Place[0]);
    }
  });
  std::sort(middles.begin(), middles.end(),
    [](const Middle& a, const Middle& b) { return a.Ring < b.Ring; });
  for (auto middle = middles.begin(); middle != middles.end();)
  {
    const auto end = std::find_if(
      middle, middles.end(), [&](const Middle& other) { return other.Ring != middle->Ring; });
    const auto inside = std::count_if(middle, end, [](const Middle& one) { return one.IsInside; });
    // A ring is inside if most of its middles are.
    around[middle->Ring] += 2 * inside > end - middle ? 1 : 0;
    middle = end;
  }
}

// Divides each edge into the fewest equal parts no longer than longestAt().
std::vector<DividingPoint> RegionMap::Divide(
  const std::function<double(const Point<2>&)>& longestAt, const Context& context)
{
  Progress progress(context);
  progress.Expect(this->Edges());
  const auto equalParts = [&](const Point<2>& low, const Point<2>& high, std::vector<double>& at) {
    const double longest = longestAt({ 0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]) });
    const auto parts = static_cast<std::int64_t>(
      std::ceil(std::hypot(high[0] - low[0], high[1] - low[1]) / longest - 1e-9));
    for (std::int64_t k = 1; k < parts; ++k)
    {
      at.push_back(static_cast<double>(k) / static_cast<double>(parts));
    }
  };
  return this->DivideEdges(
    equalParts, [this](std::int64_t corner, double) { return this->Sides[Index(corner)]; },
    progress);
}

// Directs an edge by the coordinates of its ends, so that coincident edges of different points are
// divided in the same direction, with the same rounding.
bool RegionMap::IsUp(std::int64_t from, std::int64_t to) const
{
  const Point<2>& a = this->Places[Index(from)];
  const Point<2>& b = this->Places[Index(to)];
  return a != b ? a < b : from < to;
}

// Rebuilds the rings with divided edges. New points are shared between rings by the numbers of the
// edge's ends.
std::vector<DividingPoint> RegionMap::DivideEdges(
  const std::function<void(const Point<2>&, const Point<2>&, std::vector<double>&)>& atOf,
  const std::function<Side(std::int64_t, double)>& sideOf, Progress& progress)
{
  // The first new point of each edge, counted from its lower end.
  std::unordered_map<Edge, std::int64_t, EdgeHash> firsts;
  std::vector<DividingPoint> added;
  std::vector<std::int64_t> corners;
  std::vector<std::int64_t> begins{ 0 };
  std::vector<Side> sides;
  std::vector<double> at;
  for (std::int64_t ring = 0; ring < this->Rings(); ++ring)
  {
    this->VisitCorners(ring, [&](std::int64_t corner, std::int64_t from, std::int64_t to) {
      progress.Add(1);
      corners.push_back(from);
      const bool isUp = this->IsUp(from, to);
      const Edge edge = isUp ? Edge{ from, to } : Edge{ to, from };
      const Point<2> low = this->Places[Index(edge.Low)];
      const Point<2> high = this->Places[Index(edge.High)];
      at.clear();
      atOf(low, high, at);
      const auto parts = static_cast<std::int64_t>(at.size()) + 1;
      for (std::int64_t k = 0; !this->Crossed.empty() && k < parts; ++k)
      {
        // A part's side is that at its middle.
        const std::int64_t part = isUp ? k : parts - 1 - k;
        const double begin = part > 0 ? at[Index(part) - 1] : 0.0;
        const double end = part + 1 < parts ? at[Index(part)] : 1.0;
        sides.push_back(sideOf(corner, 0.5 * (begin + end)));
      }
      if (parts <= 1)
      {
        return;
      }
      const auto [first, isNew] =
        firsts.insert({ edge, static_cast<std::int64_t>(this->Places.size()) });
      for (std::int64_t k = 1; isNew && k < parts; ++k)
      {
        const double place = at[Index(k) - 1];
        added.push_back({ edge.Low, edge.High, place });
        this->Places.push_back(
          { low[0] + place * (high[0] - low[0]), low[1] + place * (high[1] - low[1]) });
      }
      for (std::int64_t k = 1; k < parts; ++k)
      {
        // The new points from this ring's first end to its second one, in either direction of the
        // edge.
        corners.push_back(first->second + (isUp ? k : parts - k) - 1);
      }
    });
    // The last point of an open line begins no edge.
    if (this->IsOpen(ring) && this->CountOf(ring) > 0)
    {
      corners.push_back(this->CornerOf(ring, this->CountOf(ring) - 1));
      sides.resize(this->Crossed.empty() ? 0 : corners.size(), Side::None);
    }
    begins.push_back(static_cast<std::int64_t>(corners.size()));
  }
  this->Corners = std::move(corners);
  this->Begins = std::move(begins);
  this->Sides = std::move(sides);
  return added;
}

} // namespace RectifiedTransport
