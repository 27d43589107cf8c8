// SPDX-License-Identifier: BSD-3-Clause
// The points of a map of a disk in regions, for work on one region while the others stay.
#ifndef RectifiedTransport_MapRegions_h
#define RectifiedTransport_MapRegions_h

#include "Core/Geometry/Points.h"
#include "Surfaces/Mesh/DiskMesh.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

using MapRegion = std::vector<std::int64_t>; // ascending points

// The leaves of a k-d tree, at most `most` points each. `variant`, 0, 1 ..., selects the places and
// axes of the first cuts, so that the borders of regions differ. They come in groups: no triangle
// has points in two regions of a group. The regions of a group can therefore move at the same time.
std::vector<std::vector<MapRegion>> makeRegions(
  const DiskMesh& disk, ConstPointSpan<2> positions, std::int64_t most, int variant);

} // namespace RectifiedTransport

#endif
