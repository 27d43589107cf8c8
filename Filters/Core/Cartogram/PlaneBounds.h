// SPDX-License-Identifier: BSD-3-Clause
// The bounds of places along their first two axes.
#ifndef RectifiedTransport_PlaneBounds_h
#define RectifiedTransport_PlaneBounds_h

#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

struct PlaneBounds
{
  template <std::size_t Dimension>
  explicit PlaneBounds(const std::vector<std::array<double, Dimension>>& places)
  {
    for (const auto& place : places)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        this->Low[axis] = std::min(this->Low[axis], place[axis]);
        this->High[axis] = std::max(this->High[axis], place[axis]);
      }
    }
  }

  double LongestSide() const
  {
    return std::max(this->High[0] - this->Low[0], this->High[1] - this->Low[1]);
  }

  Point<2> Low{ HUGE_VAL, HUGE_VAL };
  Point<2> High{ -HUGE_VAL, -HUGE_VAL };
};

} // namespace RectifiedTransport

#endif
