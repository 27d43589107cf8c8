// SPDX-License-Identifier: BSD-3-Clause
// The conformal map of a disk to a square, with the errors of a run.
#ifndef RectifiedTransport_DiskMap_h
#define RectifiedTransport_DiskMap_h

#include "Core/Parallel/Progress.h"
#include "Core/Parameterization/ConformalMap.h"

#include <cstdint>
#include <string>

namespace RectifiedTransport::Bridge
{

// Throws Failure and Cancelled.
ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress);

// A warning about triangles that have no area in the map; Corners help if the surface is not cut.
std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles, bool isCut = false);

} // namespace RectifiedTransport::Bridge

#endif
