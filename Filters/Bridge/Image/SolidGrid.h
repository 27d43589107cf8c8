// SPDX-License-Identifier: BSD-3-Clause
// The grid of cubic cells around a solid.
#ifndef RectifiedTransport_SolidGrid_h
#define RectifiedTransport_SolidGrid_h

#include "Core/Geometry/ImageGrid.h"

#include <array>

namespace RectifiedTransport
{

// Throws Failure for properties out of range, whatever the surface is.
void requireSolidGrid(int resolution, double padding);

// `resolution` cells along the longest side of the bounds grown by `padding` of the longest side on
// each side; along the others as many as cover them, centred. Throws Failure, which names the
// property.
ImageGrid solidGrid(const std::array<double, 6>& bounds, int resolution, double padding);

} // namespace RectifiedTransport

#endif
