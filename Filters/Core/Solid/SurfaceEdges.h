// SPDX-License-Identifier: BSD-3-Clause
// The edges of a surface of triangles: whether it is closed, and which way its triangles turn.
#ifndef RectifiedTransport_SurfaceEdges_h
#define RectifiedTransport_SurfaceEdges_h

#include "Core/Parallel/LargeBuffer.h"

#include <atomic>
#include <cstdint>

namespace RectifiedTransport
{

// Side 3t+i of triangle t goes from its corner i to the next. Two sides that join the same two
// points are one edge.
class SurfaceEdges
{
public:
  // `triangles` holds three different indices each of points from 0 to points - 1. Throws
  // std::bad_alloc.
  SurfaceEdges(const std::int64_t* triangles, std::int64_t count, std::int64_t points);

  // The three steps, each over all triangles or points. The first two take ranges in ascending
  // order, on one thread; Pair takes any ranges on any threads.
  void Count(std::int64_t firstTriangle, std::int64_t lastTriangle);
  void Sort(std::int64_t firstTriangle, std::int64_t lastTriangle);
  void Pair(std::int64_t firstPoint, std::int64_t lastPoint);

  // Edges of one side, edges of more than two, and edges of two that run the same way.
  std::int64_t Open() const { return this->NumberOpen; }
  std::int64_t NonManifold() const { return this->NumberNonManifold; }
  std::int64_t Reversed() const { return this->NumberReversed; }

  // The other side of a side's edge, if that is neither open nor non-manifold.
  std::int64_t Other(std::int64_t side) const { return this->Others.data()[side]; }

private:
  struct Ends
  {
    std::int64_t Low;
    std::int64_t High;
    bool Up; // from low to high
  };
  Ends EndsOf(std::int64_t side) const;
  void PairGroup(const std::int64_t* sides, std::int64_t count);

  const std::int64_t* Triangles;
  LargeBuffer<std::int64_t> First;  // of the sides whose lower end is a point
  LargeBuffer<std::int64_t> Sides;  // by their lower ends
  LargeBuffer<std::int64_t> Others; // by sides
  std::atomic<std::int64_t> NumberOpen{ 0 };
  std::atomic<std::int64_t> NumberNonManifold{ 0 };
  std::atomic<std::int64_t> NumberReversed{ 0 };
};

} // namespace RectifiedTransport

#endif
