// SPDX-License-Identifier: BSD-3-Clause
// Regions of a plane between closed rings of straight edges, whose points move.
#ifndef RectifiedTransport_RegionMap_h
#define RectifiedTransport_RegionMap_h

#include "../Geometry/Points.h"
#include "../Parallel/Context.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// A point that divides an edge: (1 - At) * First + At * Second of earlier points, by their numbers.
struct DividingPoint
{
  std::int64_t First;
  std::int64_t Second;
  double At;
};

// Points and regions are numbered from 0. Rings may share points, and a region may have several
// rings: what is inside an odd number of them, or of the turns of one that crosses itself, belongs
// to it. Rings may run in either direction, touch themselves, and go to a hole and back. Open lines
// belong to no region; they are numbered among the rings.
class RegionMap
{
public:
  RegionMap() = default;

  std::int64_t AddPoint(const Point<2>& place);
  // The points of a ring in their order, the first one not again at the end.
  void AddRing(std::int32_t region, const std::vector<std::int64_t>& points);
  // The points of an open line in their order.
  void AddLine(const std::vector<std::int64_t>& points) { this->AddRing(noRegion, points); }
  // After all rings: finds the holes. Where rings of a region cross themselves or each other, their
  // edges are divided, as Divide does it. Throws Cancelled.
  std::vector<DividingPoint> FindHoles(const Context& context = Context());

  std::vector<Point<2>>& Points() { return this->Places; }
  const std::vector<Point<2>>& Points() const { return this->Places; }
  // The number of edges of all rings.
  std::int64_t Edges() const { return static_cast<std::int64_t>(this->Corners.size()); }
  std::int64_t Rings() const { return static_cast<std::int64_t>(this->Regions.size()); }
  std::int32_t RegionOf(std::int64_t ring) const { return this->Regions[Index(ring)]; }
  bool IsOpen(std::int64_t ring) const { return this->RegionOf(ring) == noRegion; }
  bool IsHole(std::int64_t ring) const { return this->Holes[Index(ring)] != 0; }
  // Whether the points of a ring have its region on the right.
  bool IsTurned(std::int64_t ring) const { return this->Turned[Index(ring)] != 0; }
  // Points of a ring.
  std::int64_t CountOf(std::int64_t ring) const
  {
    return this->Begins[Index(ring) + 1] - this->Begins[Index(ring)];
  }
  std::int64_t CornerOf(std::int64_t ring, std::int64_t corner) const
  {
    return this->Corners[Index(this->Begins[Index(ring)] + corner)];
  }

  // The rings of each region.
  std::vector<std::vector<std::int64_t>> RingsOfRegions() const;

  // Calls visit(from, to) for the edges of a ring, directed so that the region was on the left in
  // FindHoles.
  template <class Visit>
  void VisitEdges(std::int64_t ring, const Visit& visit) const
  {
    const bool isTurned = this->Turned[Index(ring)] != 0;
    const bool isCrossed = this->IsCrossed(ring);
    this->VisitCorners(ring, [&](std::int64_t corner, std::int64_t from, std::int64_t to) {
      const Side side = isCrossed ? this->Sides[Index(corner)]
        : isTurned                ? Side::Right
                                  : Side::Left;
      if (side != Side::None)
      {
        side == Side::Right ? visit(to, from) : visit(from, to);
      }
    });
  }

  // The area within a ring; negative if it has turned over since FindHoles. If rings of a region
  // cross, the first one has all of its area.
  double AreaOf(std::int64_t ring) const;
  // Returns the areas of the regions, without their holes.
  std::vector<double> Areas(std::int32_t regions) const;

  // Divides edges into equal parts no longer than longestAt(middle of the edge). The new points are
  // numbered on from the last one. Edges with the same ends get the same points, and edges whose
  // ends lie in the same places get points in the same places, to the last bit. Throws Cancelled.
  std::vector<DividingPoint> Divide(
    const std::function<double(const Point<2>&)>& longestAt, const Context& context = Context());

private:
  // A ring's bounds, and middles of a few of its edges: a ring may touch one around it in a few
  // points, hardly in the middles of most of its edges.
  struct RingShape
  {
    Point<2> Low;
    Point<2> High;
    std::vector<Point<2>> Middles;

    bool Contains(const RingShape& other) const
    {
      return this->Low[0] <= other.Low[0] && this->Low[1] <= other.Low[1] &&
        this->High[0] >= other.High[0] && this->High[1] >= other.High[1];
    }
  };

  static constexpr std::int32_t noRegion = -1;

  // Where the region is beside an edge of rings that cross.
  enum class Side : signed char
  {
    Left,
    Right,
    None // on both sides or on none
  };
  // A part of an edge between two crossings, from its lower end at 0 to the upper one at 1; ends
  // are in the order of their coordinates.
  struct EdgePart
  {
    double From;
    double To;
    RegionMap::Side Side;
  };
  using EdgeParts = std::map<std::int64_t, std::vector<EdgePart>>; // by corners

  static std::size_t Index(std::int64_t i) { return static_cast<std::size_t>(i); }
  // Calls visit(corner, from, to) for the edges of a ring, in its order and direction.
  template <class Visit>
  void VisitCorners(std::int64_t ring, const Visit& visit) const
  {
    const std::int64_t begin = this->Begins[Index(ring)];
    const std::int64_t end = this->Begins[Index(ring) + 1];
    const std::int64_t last = this->IsOpen(ring) ? end - 1 : end; // one beyond the last
    for (std::int64_t i = begin; i < last; ++i)
    {
      visit(i, this->Corners[Index(i)], this->Corners[Index(i + 1 < end ? i + 1 : begin)]);
    }
  }
  bool IsCrossed(std::int64_t ring) const { return this->Crossed.count(this->RegionOf(ring)) > 0; }
  bool IsUp(std::int64_t from, std::int64_t to) const;
  double WindingArea(std::int64_t ring) const;
  double CrossedArea(const std::vector<std::int64_t>& rings) const;
  RingShape ShapeOf(std::int64_t ring) const;
  void CountAround(std::int64_t outer, const std::vector<std::int64_t>& rings,
    const std::vector<RingShape>& shapes, std::vector<int>& around, Progress& progress) const;
  void FindParts(const std::vector<std::int64_t>& rings, EdgeParts& parts, Progress& progress);
  std::vector<DividingPoint> DivideAtCrossings(const EdgeParts& parts, Progress& progress);
  // Divides edges at the places that atOf(lower end, upper end, places) lists, in rising order.
  // sideOf(corner, place) gives the region's side for the part of an edge around a place.
  std::vector<DividingPoint> DivideEdges(
    const std::function<void(const Point<2>&, const Point<2>&, std::vector<double>&)>& atOf,
    const std::function<Side(std::int64_t, double)>& sideOf, Progress& progress);

  std::vector<Point<2>> Places;
  std::vector<std::int64_t> Corners; // points of all rings
  std::vector<std::int64_t> Begins{ 0 };
  std::vector<std::int32_t> Regions;
  std::vector<unsigned char> Holes;
  std::vector<unsigned char> Turned; // whether a ring has its region on the right
  std::map<std::int32_t, std::vector<std::int64_t>> Crossed; // regions whose rings cross
  std::vector<Side> Sides; // side of each edge, by its first corner, if rings cross
};

} // namespace RectifiedTransport

#endif
