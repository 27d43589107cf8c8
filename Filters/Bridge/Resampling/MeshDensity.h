// SPDX-License-Identifier: BSD-3-Clause
// The density of other data sets, resampled to a grid: the value of a grid cell is the mean over
// it, 0 outside the data sets.
#ifndef RectifiedTransport_MeshDensity_h
#define RectifiedTransport_MeshDensity_h

#include "Bridge/Blocks/BlockValues.h"
#include "Core/Geometry/ImageGrid.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Writes the mean over each cell of the grid. Point values are linear on the simplices of a cell; a
// region has one value. Returns warnings about what carries no mass. Throws Failure and Cancelled.
std::vector<std::string> resampleCells(const std::vector<BlockValues>& blocks,
  const ImageGrid& grid, Progress& progress, double* density);

// The integral of the densities, in cells of the grid.
double integralOf(
  const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
