// SPDX-License-Identifier: BSD-3-Clause
// The different places of points: regions beside each other often have points of their own on their
// border, which move together.
#ifndef RectifiedTransport_DistinctPlaces_h
#define RectifiedTransport_DistinctPlaces_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class DistinctPlaces
{
public:
  // Throws Cancelled.
  explicit DistinctPlaces(const std::vector<Point<2>>& points, const Context& context = Context());

  // In the order of the first points there.
  const std::vector<Point<2>>& Places() const { return this->Found; }

  // Moves the points to where their places have moved to.
  void Move(const std::vector<Point<2>>& moved, std::vector<Point<2>>& points) const;

private:
  std::vector<Point<2>> Found;
  std::vector<std::int64_t> PlaceOf; // of each point
};

} // namespace RectifiedTransport

#endif
