// SPDX-License-Identifier: BSD-3-Clause
// Makes the masses of site cells equal to the mass of a pixel if pixels have different masses;
// EqualizeSiteCells.h is for pixels that count equally.
#ifndef RectifiedTransport_EqualizeSiteMasses_h
#define RectifiedTransport_EqualizeSiteMasses_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"
#include "Core/SiteCells/PixelMasses.h"
#include "Core/SiteCells/SiteGroups.h"

#include <cstdint>

namespace RectifiedTransport
{

// `owners` has the number of each pixel's group of sites; every group has some mass. Moves pixels
// on the borders to a neighbouring group until each group has its share of the mass for every site
// in it, to the mass of the heaviest pixel if pixels allow; pixels nearly without mass make way for
// others. Pixels that add least to the mean squared distance from the groups, which are at
// `places`, move first; `spacing` are the lengths of a pixel's sides. Throws std::bad_alloc and
// Cancelled.
template <int Dimension>
void equalizeSiteMasses(const SiteGroups& groups, const PixelMasses<Dimension>& masses,
  ConstPointSpan<Dimension> places, const Point<Dimension>& spacing, std::int64_t* owners,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
