// SPDX-License-Identifier: BSD-3-Clause
// Which cells of data sets carry mass: those of the highest dimension. In data sets of lines,
// closed lines around regions of a plane.
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
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct MassCells
{
  int Dimension = 0;           // of the domain
  bool AreClosedLines = false; // which are around regions of a plane

  // Whether a block's cell has the dimension; other cells carry no mass.
  bool HasDimension(vtkDataSet* data, vtkIdType cell) const;
  // Whether a cell carries mass. If so, finds its points.
  bool Find(vtkDataSet* data, vtkIdType cell, vtkIdList* points) const;
};

// For blocks whose cells have at most this dimension. Lines are around regions if a closed one is
// not on a straight line. Throws Cancelled.
MassCells massCells(const std::vector<DensityBlock>& blocks, int dimension, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
