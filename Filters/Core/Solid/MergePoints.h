// SPDX-License-Identifier: BSD-3-Clause
// Which points have the same coordinates.
#ifndef RectifiedTransport_MergePoints_h
#define RectifiedTransport_MergePoints_h

#include "Core/Parallel/LargeBuffer.h"

#include <cstdint>

namespace RectifiedTransport
{

// A table of coordinates by their bits, so that the time is linear however the points lie. (Lists
// of the points in the boxes of a grid take the square of it where most points are in one box.)
class MergePoints
{
public:
  // `points` holds three finite coordinates each. Throws std::bad_alloc.
  MergePoints(const double* points, std::int64_t count);

  // Enters points [first, last); all points in ascending order, on one thread.
  void Enter(std::int64_t first, std::int64_t last);

  // The first point that has the coordinates of point i, once all are entered.
  std::int64_t First(std::int64_t i) const { return this->Firsts.data()[i]; }

private:
  std::uint64_t PlaceOf(const double* point) const;

  const double* Points;
  LargeBuffer<std::int64_t> Firsts;
  LargeBuffer<std::int64_t> Table; // of points, -1 where it is free
  std::uint64_t Mask;
};

} // namespace RectifiedTransport

#endif
