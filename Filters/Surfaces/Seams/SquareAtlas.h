// SPDX-License-Identifier: BSD-3-Clause
// Squares of given areas, side by side in the unit square.
#ifndef RectifiedTransport_SquareAtlas_h
#define RectifiedTransport_SquareAtlas_h

#include "../../Core/Geometry/Points.h"

#include <vector>

namespace RectifiedTransport
{

struct AtlasSquare
{
  Point<2> Low; // its lower left corner
  double Side;  // length, in units of the unit square's side
};

// The areas of the squares are in proportion to the given ones, which are above 0. They are in
// rows, the largest first, and as large as rows let them be. Between any two there is at least
// atlasMargin(). One square alone is the unit square. O(squares log squares). Throws
// std::bad_alloc.
std::vector<AtlasSquare> arrangeSquares(const std::vector<double>& areas);

// 1/64 of a square of a regular grid of so many squares; 0 for one.
double atlasMargin(std::size_t squares);

} // namespace RectifiedTransport

#endif
