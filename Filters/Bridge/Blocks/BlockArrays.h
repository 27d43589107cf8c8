// SPDX-License-Identifier: BSD-3-Clause
// Which array of the blocks of a density is the density, and which blocks have it.
#ifndef RectifiedTransport_BlockArrays_h
#define RectifiedTransport_BlockArrays_h

#include "Bridge/Blocks/DensityBlocks.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

struct BlockArrays
{
  // Finds the array of a data set and sets its association, or throws Failure. If no block has the
  // array, the Failure of the first block of the highest dimension is thrown.
  using Find = std::function<vtkDataArray*(const DensityBlock&, int& association)>;
  // Whether a data set has no arrays to choose from. Find may then fail, and another block is
  // asked.
  using MayLack = std::function<bool(vtkDataSet*)>;

  // Sets the arrays of the blocks and removes blocks that cannot carry mass: those of fewer
  // dimensions than the blocks with the array, and those of more dimensions without it. Throws
  // Failure.
  static BlockArrays Set(
    const Find& find, const MayLack& mayLack, std::vector<DensityBlock>& blocks);

  bool OnPoints = false;
  int Dimension = 0;
  std::int64_t Without = 0; // blocks that lack it, of as many dimensions or more
  std::int64_t All = 0;     // and all of these
};

} // namespace RectifiedTransport

#endif
