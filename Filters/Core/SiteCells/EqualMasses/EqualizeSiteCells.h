// SPDX-License-Identifier: BSD-3-Clause
// Makes site cells equal to one pixel. The cells of the flow differ by the error of the
// integration, and at the borders, because a pixel on a border belongs to one side.
#ifndef RectifiedTransport_EqualizeSiteCells_h
#define RectifiedTransport_EqualizeSiteCells_h

#include "Core/Parallel/Context.h"
#include "Core/SiteCells/SiteDensity.h"

#include <cstdint>

namespace RectifiedTransport
{

// `owners` has the number of the site cell of each pixel; each pixel that holds sites has a site
// cell. Moves pixels on the borders to a neighbouring site cell until each has its share of all
// pixels for every site in it: as many as others or one more (in 1D: intervals in the order of the
// sites). Pixels that add least to the sum of squared distances move; `spacing` are the lengths of
// a pixel's sides. There must be a pixel for each site. Throws Cancelled.
template <int Dimension>
void equalizeSiteCells(const SiteDensity<Dimension>& sites, const Point<Dimension>& spacing,
  std::int64_t* owners, const Context& context = Context());

} // namespace RectifiedTransport

#endif
