// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surfaces/DiskMap.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"

#include <stdexcept>

namespace RectifiedTransport::Bridge
{

ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress)
{
  constexpr double bytesOfPoint = 1350.0;
  const std::int64_t points = disk.NumberOfPoints();
  try
  {
    return withMemory("the conformal map of " + std::to_string(points) + " points",
      bytesOfPoint * static_cast<double>(points),
      [&]() { return mapConformally(disk, corners, progress); });
  }
  catch (const std::invalid_argument& error)
  {
    throw Failure(std::string("The input surface ") + error.what());
  }
}

std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles, bool isCut)
{
  return std::to_string(collapsed) + " of " + std::to_string(triangles) +
    " triangles have all points on one side of the square and so no area there; subdivide the "
    "surface" +
    (isCut ? "" : ", or give Corners between these points");
}

} // namespace RectifiedTransport::Bridge
