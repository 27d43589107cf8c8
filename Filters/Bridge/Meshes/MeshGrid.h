// SPDX-License-Identifier: BSD-3-Clause
// The image on the bounds of data sets that their densities are resampled to.
#ifndef RectifiedTransport_MeshGrid_h
#define RectifiedTransport_MeshGrid_h

#include "Bridge/Blocks/MassCells.h"
#include "Core/Geometry/ImageGrid.h"

#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Columns: right-handed axes, each nearest to the axis of space with its number. Axis `main` is the
// direction: across a plane or along a line.
ImageGrid::Matrix axesAround(const Eigen::Vector3d& direction, Eigen::Index main);

// Values on cells, `resolution` cells along the longest axis, as near to cubes as whole numbers
// allow. The axes are those of space, or axes in an oblique plane or line of cells. Throws
// Cancelled, and Failure for blocks without cells of positive measure, for surfaces that are not
// plane, for lines that are not straight, for points of cells that are not finite, and for a
// resolution out of range.
ImageGrid meshGrid(const std::vector<DensityBlock>& blocks, const MassCells& cells, int resolution,
  Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
