// SPDX-License-Identifier: BSD-3-Clause
// Finds points with the same coordinates, so that work is done once for each place.
#ifndef RectifiedTransport_CoincidentPoints_h
#define RectifiedTransport_CoincidentPoints_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The size of a hash table of so many entries: a power of two, for a load factor of at most 1/2.
inline std::int64_t hashTableSize(std::int64_t count)
{
  std::int64_t size = 2;
  while (size < 2 * count)
  {
    size *= 2;
  }
  return size;
}

// Writes for each point the index of the first one with the same, finite, coordinates. Uses a hash
// table of the coordinates' bits, in linear time for any distribution of the points; the bins of a
// point locator take quadratic time if most points are in one bin. Memory: up to 32 bytes a point.
// On one thread. Throws std::bad_alloc and Cancelled.
template <int Dimension>
void mergePoints(
  ConstPointSpan<Dimension> points, std::int64_t* firsts, const Context& context = Context());

// The different places of points, such as those that regions or blocks beside each other share.
template <int Dimension>
class DistinctPoints
{
public:
  // Throws std::bad_alloc and Cancelled.
  explicit DistinctPoints(
    const std::vector<Point<Dimension>>& points, const Context& context = Context());

  // In the order of the first points there.
  const std::vector<Point<Dimension>>& Places() const { return this->Found; }
  // Moves the points to where their places have moved to.
  void Move(
    const std::vector<Point<Dimension>>& moved, std::vector<Point<Dimension>>& points) const;

private:
  std::vector<Point<Dimension>> Found;
  std::vector<std::int64_t> PlaceOf; // numbers in Found, by points
};

} // namespace RectifiedTransport

#endif
