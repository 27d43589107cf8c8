// SPDX-License-Identifier: BSD-3-Clause
// Few numbers for the site cells of a labelled image, such that neighbours differ: to colour by.
#ifndef RectifiedTransport_SiteColors_h
#define RectifiedTransport_SiteColors_h

#include "../Geometry/GridSize.h"
#include "../Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Returns a number for each of `sites` sites: the least that no site of a lower id has whose cell
// shares a face of a pixel with its own; 0 for sites without a pixel. Cells with more than 254
// neighbours of lower ids may have the number 255 in common. Throws std::bad_alloc and Cancelled.
template <int Dimension>
std::vector<std::uint8_t> colourSiteCells(const GridSize<Dimension>& size,
  const std::int64_t* labels, std::int64_t sites, const Context& context = Context());

} // namespace RectifiedTransport

#endif
