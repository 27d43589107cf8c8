// SPDX-License-Identifier: BSD-3-Clause
// The blocks of a map as one vtkPolyData.
#ifndef RectifiedTransport_RegionBlocks_h
#define RectifiedTransport_RegionBlocks_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

struct RegionBlocks
{
  // With double points and the arrays that all blocks have. Its cells are numbered as those of a
  // vtkPolyData: vertices, lines, polygons, each block by block.
  vtkSmartPointer<vtkPolyData> Data;
  std::vector<std::size_t> Blocks; // the block of each cell
  std::vector<vtkIdType> Numbers;  // the number of each cell in its block
};

// Joins blocks that are vtkPolyData, or vtkUnstructuredGrid with cells that a vtkPolyData may have.
// Triangle strips and quadratic cells come as their outlines. Throws Failure for others and for
// data that cannot be read; and Cancelled.
RegionBlocks joinRegionBlocks(const std::vector<DensityBlock>& blocks, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
