// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites made equal to the pixel. What the flow gives is equal but for the error of the
// integration, and for the borders: a pixel that a border cuts belongs to one side.
#ifndef RectifiedTransport_EqualizeSiteCells_h
#define RectifiedTransport_EqualizeSiteCells_h

#include "Core/Parallel/Context.h"
#include "Core/SiteCells/SiteDensity.h"

#include <cstdint>

namespace RectifiedTransport
{

// `owners` says of each pixel of the grid which of the pixels with sites it goes to. Moves pixels
// on the borders to a neighbour, until each has its share of all pixels for every site in it: as
// many as others or one more (in 1D: intervals in the order of the sites). Those move that add
// least to the sum of squared distances; `spacing` are the lengths of a pixel's sides. There must
// be a pixel for each site. Throws Cancelled.
template <int Dimension>
void equalizeSiteCells(const SiteDensity<Dimension>& sites, const Point<Dimension>& spacing,
  std::int64_t* owners, const Context& context = Context());

} // namespace RectifiedTransport

#endif
