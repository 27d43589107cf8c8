// SPDX-License-Identifier: BSD-3-Clause
// The data sets of a data object, and in each the array that is the density.
#ifndef RectifiedTransport_DensityBlocks_h
#define RectifiedTransport_DensityBlocks_h

#include "Bridge/Blocks/DataContent.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct DensityBlock
{
  vtkSmartPointer<vtkDataSet> Data;
  std::string Name;    // that messages call it by
  std::int64_t Number; // among the leaves of a composite data set
  std::uint64_t Time;  // of the data object that the block is of
  // The density; set by those who know its name, none: no mass.
  vtkSmartPointer<vtkDataArray> Array = nullptr;
};

// Blocks whose arrays have one name and association. At least one block has an array; those without
// it carry no mass but are part of the domain.
struct DensityBlocks
{
  std::vector<DensityBlock> All;
  bool OnPoints;
  int Dimension; // the largest of a block's cells
};

// The leaves of a composite data set that are not data sets with cells, such as tables.
struct OtherLeaves
{
  std::int64_t Count = 0;
  std::int64_t DataSets = 0; // the number of the other leaves
  std::string First;         // the class and the name of the first one
};

// The data sets with points: the object itself, or the leaves of a composite; the cells of hyper
// tree grids. AMR cells covered by finer ones are marked as refined. Other leaves are left out and
// recorded in `others`. Collective. Throws Failure as withRefinedMarked, and Cancelled.
std::vector<DensityBlock> densityBlocks(vtkDataObject* data, OtherLeaves* others = nullptr,
  Progress* progress = nullptr, const Ranks& ranks = SoloRanks::Get());

// Adds everything that a block's points and cells are made of, with ghost flags; and all arrays.
void addGeometry(const DensityBlock& block, DataContent& content);
void addArrays(const DensityBlock& block, DataContent& content);

} // namespace RectifiedTransport::Bridge

#endif
