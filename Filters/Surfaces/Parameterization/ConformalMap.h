// SPDX-License-Identifier: BSD-3-Clause
// Conformal maps of disks to rectangles, scaled to the unit square (paper, Section 5.4).
#ifndef RectifiedTransport_ConformalMap_h
#define RectifiedTransport_ConformalMap_h

#include "../../Core/Geometry/Points.h"
#include "../../Core/Parallel/Context.h"
#include "../Mesh/DiskMesh.h"
#include "SquareCorners.h"

#include <vector>

namespace RectifiedTransport
{

// A map of a disk's points to the unit square: linear on each triangle, boundary points on the
// sides.
struct SquareMap
{
  std::vector<Point<2>> Positions; // by points, in [0,1]^2
  // By points: bit 0 if the point is on the left or right side, bit 1 if on the lower or upper
  // side; both at corners.
  std::vector<unsigned char> OnSides;
  SquareCorners Corners;
};

struct ConformalMap
{
  SquareMap Square;
  // Width / height of the rectangle that the surface is mapped to conformally, before scaling to
  // the unit square.
  double AspectRatio;
};

// Both coordinates are harmonic: 0 and 1 on two opposite sides, with no normal derivative on the
// others; their conjugate sides make them a conformal map to a rectangle. Uses finite elements on
// the surface's intrinsic Delaunay triangulation (Bobenko and Springborn 2007); its weights are not
// negative up to rounding. Its edges stay straight, the surface's not always, so that a few of the
// surface's triangles may be flipped.
//
// Corners are those of chooseCorners or orderCorners. Cost: two sparse Cholesky factorizations,
// about O(points^1.5). Memory: 700 to 1350 bytes a point. Throws std::invalid_argument for other
// corners, more than 2^24 points or triangles that are too thin, std::bad_alloc and Cancelled.
ConformalMap mapConformally(
  const DiskMesh& disk, const SquareCorners& corners, const Context& context = Context());

} // namespace RectifiedTransport

#endif
