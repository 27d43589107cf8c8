// SPDX-License-Identifier: BSD-3-Clause
// Gives small parts that are cut off from their site cell to the cells around them.
#ifndef RectifiedTransport_MergeComponents_h
#define RectifiedTransport_MergeComponents_h

#include "Core/SiteCells/PixelMasses.h"
#include "Core/SiteCells/SiteGroups.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// `owners` has the number of each pixel's group of sites. The pixels of a group that are connected
// by their faces are a part of it. Each part but a group's heaviest one joins the group with which
// it has most faces in common, if it has at most a tenth of the mass for a site. Returns how many
// parts join. Takes 8 bytes a pixel. Throws std::bad_alloc and Cancelled.
template <int Dimension>
std::int64_t mergeComponents(const SiteGroups& groups, const PixelMasses<Dimension>& masses,
  std::int64_t* owners, Progress& progress);

} // namespace RectifiedTransport

#endif
