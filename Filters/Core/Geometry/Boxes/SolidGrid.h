// SPDX-License-Identifier: BSD-3-Clause
// The grid of cubic cells around a solid.
#ifndef RectifiedTransport_SolidGrid_h
#define RectifiedTransport_SolidGrid_h

#include "Core/Geometry/ImageGrid.h"

#include <array>

namespace RectifiedTransport
{

// Throws Failure for properties that are out of range for any surface.
void requireSolidGrid(int resolution, double padding);

// Grows the bounds by `padding` of their longest side on each side. The longest side gets
// `resolution` cells, the others as many as cover them, centred. Throws Failure, which names the
// property.
ImageGrid solidGrid(const std::array<double, 6>& bounds, int resolution, double padding);

} // namespace RectifiedTransport

#endif
