// SPDX-License-Identifier: BSD-3-Clause
// The image on the bounds of data sets that their densities are put on.
#ifndef RectifiedTransport_MeshGrid_h
#define RectifiedTransport_MeshGrid_h

#include "Bridge/Blocks/MassCells.h"
#include "Core/Geometry/ImageGrid.h"

#include <vector>

namespace RectifiedTransport
{

class Progress;

// Columns: right-handed axes, each nearest to that of space with its number, of which `main` is the
// direction: that across a plane, or along a line.
ImageGrid::Matrix axesAround(const Eigen::Vector3d& direction, Eigen::Index main);

// Values on cells, with `resolution` cells along the longest axis and the others as near to cubes
// as whole numbers allow. The axes are those of space, or where cells of a plane or a line are
// oblique, axes in it. Throws Failure for blocks without cells of a measure, for surfaces that are
// not plane and lines that are not straight, for points of cells that are not finite, and for a
// resolution out of range; and Cancelled.
ImageGrid meshGrid(const std::vector<DensityBlock>& blocks, const MassCells& cells, int resolution,
  Progress& progress);

} // namespace RectifiedTransport

#endif
