// SPDX-License-Identifier: BSD-3-Clause
// Which boxes have an optimal map.
#ifndef RectifiedTransport_BoxCheck_h
#define RectifiedTransport_BoxCheck_h

#include "Core/Geometry/GridSize.h"

namespace RectifiedTransport
{

// Throws std::invalid_argument unless all sides of a density's box are positive, with finite
// squares.
template <int Dimension>
void checkBox(const Point<Dimension>& low, const Point<Dimension>& high);

// Throws std::invalid_argument if a side of the domain is more than 1e120 times as long as another
// one: squared sides of cells would vanish beside others.
template <int Dimension>
void checkSides(const Point<Dimension>& sides);

} // namespace RectifiedTransport

#endif
