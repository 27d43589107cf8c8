// SPDX-License-Identifier: BSD-3-Clause
// The densities of data sets, read from their arrays.
#ifndef RectifiedTransport_BlockValues_h
#define RectifiedTransport_BlockValues_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Density/UnusualValues.h"
#include "Core/Resampling/CellValues.h"

#include <limits>
#include <string>
#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct BlockValues
{
  std::vector<CellValues> Cells; // one for each block
  struct Source
  {
    vtkSmartPointer<vtkDataSet> Data;
    std::string Block; // their names in messages
    std::string Array;
    UnusualValues Known;                                    // with the white of this block
    double Least = std::numeric_limits<double>::infinity(); // value of counted cells
  };
  std::vector<Source> Sources;
};

// What the property Component takes of blocks that all have an array: an index, Luminance or
// Magnitude. Throws Failure if a block does not have it, or Auto takes different ones of several
// components.
int takenComponent(const std::vector<DensityBlock>& blocks, int component);

// `sets` are the cells of the blocks, which all have an array. Throws Failure for values of counted
// cells that are no density, and Cancelled.
BlockValues readBlocks(const std::vector<DensityBlock>& blocks, const CellSets& sets, bool onPoints,
  const MassCells& mass, const DensityRules& rules, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
