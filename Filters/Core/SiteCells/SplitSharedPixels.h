// SPDX-License-Identifier: BSD-3-Clause
// From the pixels that hold sites to the sites: those in one pixel divide its cell.
#ifndef RectifiedTransport_SplitSharedPixels_h
#define RectifiedTransport_SplitSharedPixels_h

#include "Core/Parallel/Context.h"
#include "Core/SiteCells/SiteDensity.h"

#include <cstdint>

namespace RectifiedTransport
{

// Turns `owners`, which say of each pixel which of the pixels with sites it goes to, into the
// numbers of sites. A cell of several sites is cut into halves, and these again, until each has
// a part, equal to the pixel: across the axis along which the sites differ most, or where they do
// not differ the cell's longest one. `coordinates` are the sites', `spacing` the lengths of a
// pixel's sides. Throws Cancelled.
template <int Dimension>
void splitSharedPixels(const SiteDensity<Dimension>& sites, ConstPointSpan<Dimension> coordinates,
  const Point<Dimension>& spacing, std::int64_t* owners, const Context& context = Context());

} // namespace RectifiedTransport

#endif
