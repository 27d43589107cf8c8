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

// The four points with an angle of their triangles of at most 120 degrees, if there are exactly
// four; else points near the quarters of the boundary's length. An inner edge that joins two
// boundary points cuts the boundary into two parts. Each part must have a corner inside; otherwise
// it would lie on one side of the square, and what it cuts off would have no area. If four corners
// are not enough, the longest parts get them.
SquareCorners chooseCorners(const DiskMesh& disk);

// Corners near the quarters of the boundary's length, from a part of it, 0 to 1, after the first of
// some corners on. The same corners if those others would leave more triangles without area.
SquareCorners turnCorners(const DiskMesh& disk, const SquareCorners& corners, double part);

// Four given points, the first as given and the others in the order of the boundary. Throws
// std::invalid_argument unless they are four different points of the boundary; its message uses
// `names` for the points if there are any.
SquareCorners orderCorners(const DiskMesh& disk, const std::vector<std::int64_t>& points,
  const std::vector<std::int64_t>& names = {});

// The number of triangles with all three points on one side of the square: they have no area there.
std::int64_t countCollapsed(const DiskMesh& disk, const SquareCorners& corners);

} // namespace RectifiedTransport

#endif
