// SPDX-License-Identifier: BSD-3-Clause
// The cells of blocks and the grid for their density, with the errors and warnings about them.
#ifndef RectifiedTransport_CellGrid_h
#define RectifiedTransport_CellGrid_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Cells/BlockValues.h"
#include "Core/Resampling/CellLattice.h"
#include "Core/Resampling/CellPieces.h"

#include <optional>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

// Throws Failure for ghost arrays of a wrong length.
CellSets cellSetsOf(const std::vector<DensityBlock>& blocks);

// The image whose cells a filter such as Threshold turned into voxels, hexahedra, pixels,
// quadrilaterals or lines; none if a cell is no box of it. `sets` are the cells of the blocks, of
// this dimension. Throws Failure if memory is short, and Cancelled.
std::optional<CellLattice> latticeOf(
  const std::vector<DensityBlock>& blocks, const CellSets& sets, int dimension, Progress& progress);

// Values on cells, `resolution` cells along the longest axis, as near to cubes as whole numbers
// allow. The axes are those of space, or axes in an oblique plane or line of cells. Throws
// Cancelled, and Failure for blocks without cells of positive measure, for surfaces that are not
// plane, for lines that are not straight, for points of cells that are not finite, and for a
// resolution out of range.
ImageGrid gridOfCells(const std::vector<DensityBlock>& blocks, const CellSets& sets,
  const MassCells& mass, int resolution, Progress& progress);

// What to warn of: cells that carry no mass. `size`: what all cells contain.
std::vector<std::string> describeLost(
  const BlockValues& blocks, const CellSize& size, int dimension);

} // namespace RectifiedTransport::Bridge

#endif
