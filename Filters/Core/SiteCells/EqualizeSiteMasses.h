// SPDX-License-Identifier: BSD-3-Clause
// Makes the masses of site cells equal to the mass of a pixel, where pixels have different masses:
// EqualizeSiteCells.h is for those that count equally.
#ifndef RectifiedTransport_EqualizeSiteMasses_h
#define RectifiedTransport_EqualizeSiteMasses_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"
#include "Core/SiteCells/PixelMasses.h"
#include "Core/SiteCells/SiteGroups.h"

#include <cstdint>

namespace RectifiedTransport
{

// `owners` holds for each pixel the number of its group of sites, each of which has some mass.
// Moves pixels on the borders to a neighbouring group until each has its share of the mass for
// every site in it, to the mass of the heaviest pixel where pixels allow; those nearly without mass
// make way for others. Those move first that add least to the mean squared distance from the
// groups, which are at `places`; `spacing` are the lengths of a pixel's sides. Throws
// std::bad_alloc and Cancelled.
template <int Dimension>
void equalizeSiteMasses(const SiteGroups& groups, const PixelMasses<Dimension>& masses,
  ConstPointSpan<Dimension> places, const Point<Dimension>& spacing, std::int64_t* owners,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
