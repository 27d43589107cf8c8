// SPDX-License-Identifier: BSD-3-Clause
// The points of a disk's boundary that become the corners of the square.
#ifndef RectifiedTransport_SquareCorners_h
#define RectifiedTransport_SquareCorners_h

#include "../Mesh/DiskMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Points in the order of the boundary: they go to (0,0), (1,0), (1,1) and (0,1).
using SquareCorners = std::array<std::int64_t, 4>;

// The four points whose angle, that of the triangles there, is at most 120 degrees, if there are
// exactly four; else points near the quarters of the boundary's length. An edge inside of the
// surface that joins two boundary points cuts the boundary into two parts: each must have a corner
// inside, as a part without one would lie on one side of the square and what is cut off would have
// no area. Where four corners are not enough for that, the longest parts get them.
SquareCorners chooseCorners(const DiskMesh& disk);

// Four given points, the first as given and the others in the order of the boundary. Throws
// std::invalid_argument unless they are four different points of the boundary; it says `names` in
// place of the points where there are any.
SquareCorners orderCorners(const DiskMesh& disk, const std::vector<std::int64_t>& points,
  const std::vector<std::int64_t>& names = {});

// How many triangles have their three points on one side of the square, so that they have no area
// there.
std::int64_t countCollapsed(const DiskMesh& disk, const SquareCorners& corners);

} // namespace RectifiedTransport

#endif
