// SPDX-License-Identifier: BSD-3-Clause
// The conformal map of a surface that is a disk, with the errors of a run.
#ifndef RectifiedTransport_DiskConformalMap_h
#define RectifiedTransport_DiskConformalMap_h

#include "Core/Parameterization/ConformalMap.h"

#include <cstdint>
#include <string>

namespace RectifiedTransport
{

class Progress;

// Runs as the current stage. Throws Failure and Cancelled.
ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress);

// A warning about triangles that have no area in the map.
std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles);

} // namespace RectifiedTransport

#endif
