// SPDX-License-Identifier: BSD-3-Clause
// The masses of triangles: their areas times a density.
#ifndef RectifiedTransport_TriangleMasses_h
#define RectifiedTransport_TriangleMasses_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/TriangleDomain.h"
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include <cstdint>
#include <functional>

namespace RectifiedTransport
{

struct TriangleMasses
{
  LargeBuffer<double> Masses; // shares of the surface's area, times the density
  double Sum = 0.0;
};

// The density at points is that at given points; its mean over a triangle is exact for linear
// interpolation. Triangles that are `isEmpty`, which may be null, have no mass. Throws
// std::bad_alloc and Cancelled.
TriangleMasses massesOf(const TriangleDomain& surface, const SurfaceDensityValues& density,
  const std::function<bool(std::int64_t)>& isEmpty, Progress& progress);

} // namespace RectifiedTransport

#endif
