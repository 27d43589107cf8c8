// SPDX-License-Identifier: BSD-3-Clause
// The value of a region whose outline's points have values.
#ifndef RectifiedTransport_RingValues_h
#define RectifiedTransport_RingValues_h

#include "Core/Overlap/RingCrossings.h"

#include <cstdint>

namespace RectifiedTransport
{

// The least-squares plane through the values at the points of a ring. The weight of a point is the
// length of the edges beside it.
class RingValues
{
public:
  // `values` are those of the points of all rings.
  RingValues(const Rings& rings, std::int64_t ring, const double* values);

  double Mean() const { return this->Value; }
  // Clamped to the smallest and the largest value.
  double At(const Point<2>& x) const;

private:
  Point<2> Middle{ 0.0, 0.0 }; // weighted mean of the ring's points, in index space
  Point<2> Slope{ 0.0, 0.0 };  // per grid cell
  double Value = 0.0;          // weighted mean of the values
  double Smallest = 0.0;
  double Largest = 0.0;
};

} // namespace RectifiedTransport

#endif
