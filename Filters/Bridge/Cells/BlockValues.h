// SPDX-License-Identifier: BSD-3-Clause
// The cells of data sets and their densities, read from their arrays.
#ifndef RectifiedTransport_BlockValues_h
#define RectifiedTransport_BlockValues_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Core/Resampling/CellLattice.h"
#include "Core/Resampling/Reading/SetReading.h"

#include <optional>
#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct BlockValues
{
  // Each has one for each block.
  std::vector<CellValues> Cells;
  std::vector<SetFindings> Findings;
  std::vector<vtkSmartPointer<vtkDataSet>> Data;
};

// Throws Failure for ghost arrays of a wrong length.
CellSets cellSetsOf(const std::vector<DensityBlock>& blocks);

// The image whose cells a filter such as Threshold turned into voxels, hexahedra, pixels,
// quadrilaterals or lines; none if a cell is no box of it. `sets` are the cells of the blocks, of
// this dimension. Throws Failure if memory is short, and Cancelled.
std::optional<CellLattice> latticeOf(
  const std::vector<DensityBlock>& blocks, const CellSets& sets, int dimension, Progress& progress);

// What the property Component takes of blocks that all have an array: an index, Luminance or
// Magnitude. Throws Failure if a block does not have it, or Auto takes different ones of several
// components.
int commonComponent(const std::vector<DensityBlock>& blocks, int component);

// `sets` are the cells of the blocks, which all have an array. Throws Failure for values of counted
// cells that are no density, and Cancelled.
BlockValues readBlocks(const std::vector<DensityBlock>& blocks, const CellSets& sets, bool onPoints,
  const MassCells& mass, const DensityRules& rules, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
