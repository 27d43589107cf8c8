// SPDX-License-Identifier: BSD-3-Clause
// Divides the site cell of a pixel that holds several sites among them.
#ifndef RectifiedTransport_SplitSharedPixels_h
#define RectifiedTransport_SplitSharedPixels_h

#include "Core/Parallel/Context.h"
#include "Core/SiteCells/PixelMasses.h"
#include "Core/SiteCells/SiteDensity.h"
#include "Core/SiteCells/SiteGroups.h"

#include <cstdint>

namespace RectifiedTransport
{

// Replaces `owners`, the numbers of the pixels' site cells, by the numbers of sites. A site cell of
// several sites is bisected recursively into parts that are equal to one pixel. Each cut is across
// the axis along which the sites or, if they coincide, the pixels have the largest extent.
// `coordinates` belong to the sites; `spacing` has the lengths of a pixel's sides. Throws
// Cancelled.
template <int Dimension>
void splitSharedPixels(const SiteDensity<Dimension>& sites, ConstPointSpan<Dimension> coordinates,
  const Point<Dimension>& spacing, std::int64_t* owners, const Context& context = Context());

// The same for any groups of sites on pixels that have masses: parts are equal to the mass of one
// pixel. If a group has a pixel with mass for each of its sites, each part has one.
template <int Dimension>
void splitGroupsByMass(const SiteGroups& groups, const PixelMasses<Dimension>& masses,
  ConstPointSpan<Dimension> coordinates, const Point<Dimension>& spacing, std::int64_t* owners,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
