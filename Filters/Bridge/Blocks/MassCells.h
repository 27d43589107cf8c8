// SPDX-License-Identifier: BSD-3-Clause
// Which cells of data sets carry mass: those of the highest dimension, and of data sets of lines
// those that are closed around regions of a plane.
#ifndef RectifiedTransport_MassCells_h
#define RectifiedTransport_MassCells_h

#include "Bridge/Blocks/DensityBlocks.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkIdList;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;

struct MassCells
{
  int Dimension = 0;           // of the domain
  bool AreClosedLines = false; // which are around regions of a plane

  // Of a block's cells, others of which carry no mass.
  bool HasDimension(vtkDataSet* data, vtkIdType cell) const;
  // Whether a cell carries mass; finds its points if so.
  bool Find(vtkDataSet* data, vtkIdType cell, vtkIdList* points) const;
};

// Of blocks whose cells have no larger dimension than this. Lines are around regions where a closed
// one is not on a straight line. Throws Cancelled.
MassCells massCells(const std::vector<DensityBlock>& blocks, int dimension, Progress& progress);

} // namespace RectifiedTransport

#endif
