// SPDX-License-Identifier: BSD-3-Clause
// Regions whose rings cross themselves or each other: by the even-odd rule each part of an edge
// between two crossings has the region on its left, on its right, or on neither side alone.
#include "Core/Cartogram/RegionMap.h"
#include "Core/Overlap/RegionOutlines.h"
#include "Core/Overlap/RingCrossings.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Returns where a point of an edge lies between its ends, in [0, 1].
double placeOn(const Point<2>& low, const Point<2>& high, const Point<2>& x)
{
  const Point<2> along{ high[0] - low[0], high[1] - low[1] };
  // The longer axis has the most digits; the square of a length may overflow.
  const std::size_t axis = std::abs(along[0]) >= std::abs(along[1]) ? 0 : 1;
  return x == low ? 0.0
    : x == high   ? 1.0
                  : std::clamp((x[axis] - low[axis]) / along[axis], 0.0, 1.0);
}

} // namespace

// Adds the parts of edges if rings of a region cross. Where rings only touch or coincide, areas
// stay as they are.
void RegionMap::FindParts(
  const std::vector<std::int64_t>& rings, EdgeParts& parts, Progress& progress)
{
  constexpr double rounding = 1e-6; // relative to the area
  RectifiedTransport::Rings outline;
  std::vector<std::int64_t> corners; // corners at which the outline's edges begin
  double area = 0.0;
  for (const std::int64_t ring : rings)
  {
    // The signed sum of the rings, which counts an area for each turn around it.
    area += this->IsHole(ring) ? -this->AreaOf(ring) : this->AreaOf(ring);
    this->VisitCorners(ring, [&](std::int64_t corner, std::int64_t from, std::int64_t) {
      progress.Add(2);
      outline.Add(this->Places[Index(from)]);
      corners.push_back(corner);
    });
    outline.EndRing();
  }
  const auto endIfCancelled = [&progress]() {
    if (progress.IsCancelled())
    {
      progress.Check();
    }
  };
  // Most regions have no crossings, which the sweep finds out in O(n log n); the division by
  // regions takes longer.
  const bool mayCross = outline.Edges() > 3 && haveCrossings(outline, progress);
  endIfCancelled();
  if (!mayCross)
  {
    return;
  }
  const std::vector<OutlineEdge> edges =
    regionOutlines(outline, std::vector<double>(rings.size(), 0.0), progress);
  endIfCancelled();
  // If rings cross, the area by the even-odd rule differs from the signed sum of the rings' areas.
  const double evenOdd = sizeOfRegion(edges.data(), edges.data() + edges.size()).Area;
  if (std::abs(evenOdd - area) <= rounding * evenOdd)
  {
    return;
  }
  this->Crossed[this->RegionOf(rings.front())] = rings;
  for (const std::int64_t corner : corners)
  {
    parts[corner] = {};
  }
  for (const OutlineEdge& edge : edges)
  {
    const Point<2>& a = outline.At(edge.Edge);
    const Point<2>& b = outline.At(outline.Next(edge.Edge));
    // The edge's own direction decides on which side the region is.
    const bool isUp = a < b;
    const Point<2>& low = isUp ? a : b;
    const Point<2>& high = isUp ? b : a;
    // Parts are stored from the lower end of an edge, so that both directions give the same places.
    const double from = placeOn(low, high, edge.From);
    const double to = placeOn(low, high, edge.To);
    parts[corners[Index(edge.Edge)]].push_back(
      { std::min(from, to), std::max(from, to), (from < to) == isUp ? Side::Left : Side::Right });
  }
}

// Divides all edges at their crossings. The side of each part is looked up by its middle.
std::vector<DividingPoint> RegionMap::DivideAtCrossings(const EdgeParts& parts, Progress& progress)
{
  using Ends = std::pair<Point<2>, Point<2>>;
  // The places of crossings on edges, by the ends of the edge: coincident edges share them.
  std::map<Ends, std::vector<double>> crossings;
  for (std::int64_t ring = 0; ring < this->Rings(); ++ring)
  {
    this->VisitCorners(ring, [&](std::int64_t corner, std::int64_t from, std::int64_t to) {
      const auto own = parts.find(corner);
      for (const EdgePart& part : own != parts.end() ? own->second : std::vector<EdgePart>())
      {
        const Ends ends = std::minmax(this->Places[Index(from)], this->Places[Index(to)]);
        for (const double at : { part.From, part.To })
        {
          if (at > 0.0 && at < 1.0)
          {
            crossings[ends].push_back(at);
          }
        }
      }
    });
  }
  for (auto& [ends, places] : crossings)
  {
    // Each crossing is listed by both parts that it ends.
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
  }
  return this->DivideEdges(
    [&](const Point<2>& low, const Point<2>& high, std::vector<double>& at) {
      const auto found = crossings.find({ low, high });
      at = found != crossings.end() ? found->second : std::vector<double>();
    },
    [&](std::int64_t corner, double place) {
      const auto own = parts.find(corner);
      for (const EdgePart& part : own != parts.end() ? own->second : std::vector<EdgePart>())
      {
        if (part.From < place && place < part.To)
        {
          return part.Side;
        }
      }
      return Side::None;
    },
    progress);
}

// Shoelace formula relative to a point of the region, over directed edges with the region on the
// left.
double RegionMap::CrossedArea(const std::vector<std::int64_t>& rings) const
{
  double sum = 0.0;
  const Point<2>& origin = this->Places[Index(this->CornerOf(rings.front(), 0))];
  for (const std::int64_t ring : rings)
  {
    this->VisitEdges(ring, [&](std::int64_t from, std::int64_t to) {
      const Point<2>& a = this->Places[Index(from)];
      const Point<2>& b = this->Places[Index(to)];
      sum += (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
    });
  }
  return 0.5 * sum;
}

} // namespace RectifiedTransport
