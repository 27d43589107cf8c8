// SPDX-License-Identifier: BSD-3-Clause
// Points between the index space of a grid and physical space.
#ifndef RectifiedTransport_PhysicalPoints_h
#define RectifiedTransport_PhysicalPoints_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

constexpr std::int64_t grainOfPositions = std::int64_t{ 1 } << 13;

// Writes the physical places of points in index space. In 3D both arrays may share memory. Throws
// Cancelled.
template <int D>
void writePhysical(
  const ImageGrid& grid, ConstPointSpan<D> positions, Progress& progress, PointSpan<3> physical)
{
  progress.ForEach(positions.size(), grainOfPositions, [&](std::int64_t i) {
    double index[D];
    std::copy_n(positions[i], D, index);
    grid.ToPhysical<D>(index, physical[i]);
  });
}

// Moves a physical point to the nearest one of the domain, whose index it writes; one inside keeps
// its coordinates bitwise. Returns whether it was beyond the border's tolerance.
template <int D>
bool moveToDomain(const ImageGrid& grid, double* x, double* index)
{
  grid.ToIndex<D>(x, index);
  const bool isInside = grid.ClampToDomain<D>(index);
  double nearest[3];
  grid.ToPhysical<D>(index, nearest);
  const double distance = std::hypot(x[0] - nearest[0], x[1] - nearest[1], x[2] - nearest[2]);
  // Points inside come back with rounding errors from index space; those stay where they are.
  const double rounding =
    1e-12 * (grid.Diagonal() + std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
  if (!isInside || distance > rounding)
  {
    std::copy_n(nearest, 3, x);
  }
  return distance > grid.BorderTolerance();
}

} // namespace RectifiedTransport

#endif
