// SPDX-License-Identifier: BSD-3-Clause
// Closed rings of straight edges in a plane, and where their edges cross.
#ifndef RectifiedTransport_RingCrossings_h
#define RectifiedTransport_RingCrossings_h

#include "Core/Geometry/ExactOrientation.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Closed polygons. Point i begins edge i, which ends at point Next(i). Points of a ring are
// contiguous.
class Rings
{
public:
  // The point belongs to the ring that the next EndRing ends.
  void Add(const Point<2>& x) { this->Points.push_back(x); }
  void EndRing();
  void Reserve(std::int64_t points);

  std::int64_t Count() const { return static_cast<std::int64_t>(this->Begins.size()) - 1; }
  std::int64_t Edges() const { return static_cast<std::int64_t>(this->Points.size()); }
  // The first edge of a ring, and the end of the last ring.
  std::int64_t Begin(std::int64_t ring) const { return this->Begins[Index(ring)]; }
  std::int64_t Next(std::int64_t point) const { return this->Nexts[Index(point)]; }
  std::int64_t RingOf(std::int64_t point) const { return this->Owners[Index(point)]; }
  const Point<2>& At(std::int64_t point) const { return this->Points[Index(point)]; }
  NumberedPoint Numbered(std::int64_t point) const { return { this->At(point), point }; }

private:
  static std::size_t Index(std::int64_t i) { return static_cast<std::size_t>(i); }

  std::vector<Point<2>> Points;
  std::vector<std::int32_t> Nexts;       // by points
  std::vector<std::int32_t> Owners;      // rings, by points
  std::vector<std::int64_t> Begins{ 0 }; // first points, by rings, and the end
};

struct EdgePair
{
  std::int64_t First;
  std::int64_t Second;
};

// The pairs of edges that cross, each once, in order. The points' infinitesimals (symbolic
// perturbation) decide for edges that touch or lie on each other. The time is linear in the edges
// unless edges of very different lengths lie close together. `atEnds`: includes pairs of edges that
// end in one place, which may be many. Incomplete if `progress` is cancelled.
std::vector<EdgePair> findCrossings(const Rings& rings, Progress& progress, bool atEnds = true);

// Whether edges cross at all; mostly they do not. In O(n log n) for any rings, by a line that
// sweeps the plane upwards (Shamos and Hoey 1976). Touching edges are treated as in findCrossings.
// Undefined if `progress` is cancelled.
bool haveCrossings(const Rings& rings, Progress& progress);

} // namespace RectifiedTransport

#endif
