// SPDX-License-Identifier: BSD-3-Clause
// Regions of a plane between closed rings of straight edges, whose points move.
#ifndef RectifiedTransport_RegionMap_h
#define RectifiedTransport_RegionMap_h

#include "../Geometry/Points.h"
#include "../Parallel/Context.h"

#include <cstddef>
#include <cstdint>
#include <functional>
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
// rings: a ring in an odd number of others of its region is a hole. Rings may run in either
// direction, touch themselves, and go to a hole and back.
class RegionMap
{
public:
  RegionMap() = default;

  std::int64_t AddPoint(const Point<2>& place);
  // The points of a ring in their order, the first one not again at the end.
  void AddRing(std::int32_t region, const std::vector<std::int64_t>& points);
  // After all rings: finds the holes. Throws Cancelled.
  void FindHoles(const Context& context = Context());

  std::vector<Point<2>>& Points() { return this->Places; }
  const std::vector<Point<2>>& Points() const { return this->Places; }
  // Of all rings.
  std::int64_t Edges() const { return static_cast<std::int64_t>(this->Corners.size()); }
  std::int64_t Rings() const { return static_cast<std::int64_t>(this->Regions.size()); }
  std::int32_t RegionOf(std::int64_t ring) const { return this->Regions[Index(ring)]; }
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

  // visit(from, to) of the edges of a ring, with the region on the left as it was in FindHoles.
  template <class Visit>
  void VisitEdges(std::int64_t ring, const Visit& visit) const
  {
    const bool isTurned = this->Turned[Index(ring)] != 0;
    this->VisitSides(ring,
      [&](std::int64_t from, std::int64_t to) { isTurned ? visit(to, from) : visit(from, to); });
  }

  // The area within a ring; negative if it has turned over since FindHoles.
  double AreaOf(std::int64_t ring) const;
  // Of regions, without their holes.
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

  static std::size_t Index(std::int64_t i) { return static_cast<std::size_t>(i); }
  // visit(from, to) of the edges of a ring, in its order and direction.
  template <class Visit>
  void VisitSides(std::int64_t ring, const Visit& visit) const
  {
    const std::int64_t begin = this->Begins[Index(ring)];
    const std::int64_t end = this->Begins[Index(ring) + 1];
    for (std::int64_t i = begin; i < end; ++i)
    {
      visit(this->Corners[Index(i)], this->Corners[Index(i + 1 < end ? i + 1 : begin)]);
    }
  }
  double WindingArea(std::int64_t ring) const;
  RingShape ShapeOf(std::int64_t ring) const;
  void CountAround(std::int64_t outer, const std::vector<std::int64_t>& rings,
    const std::vector<RingShape>& shapes, std::vector<int>& around, Progress& progress) const;

  std::vector<Point<2>> Places;
  std::vector<std::int64_t> Corners; // of all rings
  std::vector<std::int64_t> Begins{ 0 };
  std::vector<std::int32_t> Regions;
  std::vector<unsigned char> Holes;
  std::vector<unsigned char> Turned; // whether a ring has its region on the right
};

} // namespace RectifiedTransport

#endif
