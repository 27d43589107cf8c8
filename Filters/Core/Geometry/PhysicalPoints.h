// SPDX-License-Identifier: BSD-3-Clause
// Many points from the index space of a grid to physical space.
#ifndef RectifiedTransport_PhysicalPoints_h
#define RectifiedTransport_PhysicalPoints_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

constexpr std::int64_t grainOfPositions = std::int64_t{ 1 } << 13;

// In 3D both may share memory. Throws Cancelled.
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

} // namespace RectifiedTransport

#endif
