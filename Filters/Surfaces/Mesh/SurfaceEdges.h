// SPDX-License-Identifier: BSD-3-Clause
// The edges of a triangle surface: whether it is closed, and which triangles share an edge.
#ifndef RectifiedTransport_SurfaceEdges_h
#define RectifiedTransport_SurfaceEdges_h

#include "../../Core/Parallel/Context.h"
#include "../../Core/Parallel/LargeBuffer.h"
#include "TriangleSurface.h"

#include <atomic>
#include <cstdint>

namespace RectifiedTransport
{

// Side 3t+i of triangle t goes from its corner i to the next. Two sides that join the same two
// points are one edge.
inline std::int64_t nextSide(std::int64_t side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}
inline std::int64_t lastSide(std::int64_t side)
{
  return side % 3 == 0 ? side + 2 : side - 1;
}

class SurfaceEdges
{
public:
  // The corners of a triangle are three different points. The sides are sorted by their ends, in
  // O(sides log sides) for any valence of the points. Memory: 8 bytes a side, and temporarily as
  // much again and 8 bytes a point. Throws std::bad_alloc and Cancelled.
  explicit SurfaceEdges(const TriangleSurface& surface, const Context& context = Context());

  // The numbers of edges of one side, of more than two sides, and of two sides with the same
  // direction.
  std::int64_t Open() const { return this->NumberOpen; }
  std::int64_t NonManifold() const { return this->NumberNonManifold; }
  // The number of edges of an odd number of sides above two.
  std::int64_t Odd() const { return this->NumberOdd; }
  std::int64_t Reversed() const { return this->NumberReversed; }

  // The other side of a side's edge; -1 if the edge is open or non-manifold.
  std::int64_t Other(std::int64_t side) const { return this->Others.data()[side]; }

private:
  void Pair(const std::int64_t* triangles, const std::int64_t* sides, std::int64_t count);

  LargeBuffer<std::int64_t> Others; // by sides
  // Numbers of edges; atomic, as edges are visited on any thread.
  std::atomic<std::int64_t> NumberOpen{ 0 };
  std::atomic<std::int64_t> NumberNonManifold{ 0 };
  std::atomic<std::int64_t> NumberOdd{ 0 };
  std::atomic<std::int64_t> NumberReversed{ 0 };
};

// Updates the other sides of all sides, -1 where there is none, for the flip of an edge: the side
// from a to b, of the triangles a b c and b a d, becomes the one from c to d. The triangles become
// c a d and d b c.
void flipEdge(std::int64_t* others, std::int64_t side, std::int64_t other);

} // namespace RectifiedTransport

#endif
