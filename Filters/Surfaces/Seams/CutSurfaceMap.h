// SPDX-License-Identifier: BSD-3-Clause
// The area-preserving map of a cut surface to an atlas: each disk to a square of its own.
#ifndef RectifiedTransport_CutSurfaceMap_h
#define RectifiedTransport_CutSurfaceMap_h

#include "../Parameterization/AreaPreservingMap.h"
#include "CutSurface.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct CutSurfaceMap
{
  // By points of the cut surface, in [0,1]^2. All squares have the same area in the unit square per
  // area of the surface.
  std::vector<Point<2>> Conformal;
  std::vector<Point<2>> Positions; // area-preserving, while Conformal is conformal on each disk
  double Coverage = 0.0;           // the share of the unit square that the surface covers
  std::int64_t Collapsed = 0;      // triangles with all points on one side of their square
};

// Maps each disk with mapAreaPreserving. The grid of a disk has at most four cells an axis for each
// root of its points if there are several disks. Cost and memory: those of mapAreaPreserving, and
// 32 bytes a point. Throws std::invalid_argument (options), std::bad_alloc and Cancelled.
CutSurfaceMap mapCutSurface(const CutSurface& cut, const AreaPreservingOptions& options = {},
  const Context& context = Context());

// The given triangles of a cut surface that have area, each once, oriented as in their disks.
class CutTriangles
{
public:
  // `given` is what the surface was cut from. Throws std::bad_alloc.
  CutTriangles(const CutSurface& cut, const TriangleSurface& given);

  // Their points are those of the cut surface.
  MeasuredTriangles Measured() const;
  std::int64_t Given(std::int64_t triangle) const
  {
    return this->Numbers[static_cast<std::size_t>(triangle)];
  }

private:
  std::vector<Point<3>> Points; // by points of the cut surface, divided by the largest coordinate
  std::vector<std::int64_t> Triangles; // three points each
  std::vector<std::int64_t> Numbers;   // given triangles
  std::vector<double> Shares;          // parts of the surface's area; their sum is 1
};

// Positions of a map, scaled so that the surface covers an area of 1, as the distortions of
// MapDistortion.h need them.
std::vector<Point<2>> scaledToUnitArea(const CutSurfaceMap& map);

} // namespace RectifiedTransport

#endif
