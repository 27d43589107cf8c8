// SPDX-License-Identifier: BSD-3-Clause
// Seeds that the user gives: points in physical space.
#ifndef RectifiedTransport_SeedInput_h
#define RectifiedTransport_SeedInput_h

#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/PointInput.h"
#include "Core/Geometry/PhysicalPoints.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string>

namespace RectifiedTransport::Bridge
{

// Writes the points of a set that are not ghosts in index space, clamped to the domain, in the
// order of their numbers; and all points in physical space (coordinates inside stay bitwise the
// same). Ghosts keep their coordinates. Returns how many were moved by more than a millionth of the
// domain's size, the error of single precision. Throws Failure for coordinates that are not finite,
// naming the input as `what`, and Cancelled.
template <int D>
std::int64_t readSeeds(vtkPointSet* points, const NonGhostPoints& counted, const std::string& what,
  const ImageGrid& grid, Progress& progress, PointSpan<D> indexSeeds, PointSpan<3> physicalSeeds)
{
  std::atomic<std::int64_t> moved{ 0 };
  const bool areAll = counted.Count() == points->GetNumberOfPoints();
  visitPoints(points, what, progress, [&](std::int64_t i, const double* x) {
    std::copy_n(x, 3, physicalSeeds[i]);
    if (areAll && moveToDomain<D>(grid, physicalSeeds[i], indexSeeds[i]))
    {
      ++moved;
    }
  });
  if (areAll)
  {
    return moved;
  }
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  progress.ForEach(counted.Count(), grain, [&](std::int64_t number) {
    double* seed = physicalSeeds[counted.Point(number)];
    if (moveToDomain<D>(grid, seed, indexSeeds[number]))
    {
      ++moved;
    }
  });
  return moved;
}

} // namespace RectifiedTransport::Bridge

#endif
