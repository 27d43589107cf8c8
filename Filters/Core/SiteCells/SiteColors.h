// SPDX-License-Identifier: BSD-3-Clause
// Few numbers for the site cells of a labelled image that differ between neighbours, to colour by.
#ifndef RectifiedTransport_SiteColors_h
#define RectifiedTransport_SiteColors_h

#include "../Geometry/GridSize.h"
#include "../Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Returns a number for each of `sites` sites: the smallest number that no neighbour of a lower id
// has; 0 for sites without a pixel. Neighbours share a face of a pixel. Cells with more than 254
// neighbours of lower ids may share the number 255. Throws std::bad_alloc and Cancelled.
template <int Dimension>
std::vector<std::uint8_t> colourSiteCells(const GridSize<Dimension>& size,
  const std::int64_t* labels, std::int64_t sites, const Context& context = Context());

} // namespace RectifiedTransport

#endif
