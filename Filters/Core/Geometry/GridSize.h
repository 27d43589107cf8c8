// SPDX-License-Identifier: BSD-3-Clause
// The size of a grid of cells.
#ifndef RectifiedTransport_GridSize_h
#define RectifiedTransport_GridSize_h

#include "Core/Geometry/Points.h"

#include <array>
#include <cstdint>
#include <sstream>
#include <string>

namespace RectifiedTransport
{

// Cells along each axis.
template <int Dimension>
using GridSize = std::array<std::int64_t, Dimension>;

// The place of a point in its cell, of unit sides.
template <int Dimension>
Point<Dimension> cellCentre()
{
  Point<Dimension> centre;
  centre.fill(0.5);
  return centre;
}

// Not an integer: what a user asks for may be more than fits into one.
template <int Dimension>
double numberOfCells(const GridSize<Dimension>& size)
{
  double count = 1.0;
  for (const std::int64_t cells : size)
  {
    count *= static_cast<double>(cells);
  }
  return count;
}

// The digits of such a number.
inline std::string describeCount(double count)
{
  std::ostringstream text;
  constexpr int allDigits = 17;
  text.precision(allDigits);
  text << count;
  return text.str();
}

} // namespace RectifiedTransport

#endif
