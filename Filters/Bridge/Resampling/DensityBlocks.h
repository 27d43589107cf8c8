// SPDX-License-Identifier: BSD-3-Clause
// The data sets of a data object, and in each the array that is the density.
#ifndef RectifiedTransport_DensityBlocks_h
#define RectifiedTransport_DensityBlocks_h

#include "Bridge/VTKCompatibility.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

struct DensityBlock
{
  vtkSmartPointer<vtkDataSet> Data;
  std::string Name;                    // that messages call it by
  std::int64_t Number;                 // among the leaves of a composite data set
  std::vector<std::uint64_t> Geometry; // changes with the input's own points and cells
  vtkDataArray* Array = nullptr;       // the density; set by those who know its name
};

// The data sets with points: the object itself, or the leaves of composite ones. Cells of AMR grids
// that finer ones cover are marked as refined. Throws Failure for a leaf of another type.
std::vector<DensityBlock> densityBlocks(vtkDataObject* data);

// The largest dimension of a cell of any block, and of the cells of a type.
int largestCellDimension(const std::vector<DensityBlock>& blocks);
int dimensionOfCellType(int type);

// Removes the blocks whose cells are all of fewer dimensions: only the others have mass.
void keepBlocksOfDimension(int dimension, std::vector<DensityBlock>& blocks);

} // namespace RectifiedTransport

#endif
