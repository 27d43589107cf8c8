// SPDX-License-Identifier: BSD-3-Clause
// The data sets of a data object, and in each the array that is the density.
#ifndef RectifiedTransport_DensityBlocks_h
#define RectifiedTransport_DensityBlocks_h

#include "Bridge/Store/DataIdentity.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCompositeDataSet;
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
  std::uint64_t Time;  // the modification time of the data object that holds the block
  // The density; set by those who know its name, none: no mass.
  vtkSmartPointer<vtkDataArray> Array = nullptr;
  // That of the data set of which it is a piece, or its own.
  std::int64_t Whole = Number;
};

// Blocks whose arrays have one name and association. At least one block has an array; those without
// it carry no mass but are part of the domain.
struct DensityBlocks
{
  std::vector<DensityBlock> All;
  bool OnPoints;
  int Dimension; // the largest of a block's cells
  // Polygons that lie in no plane: they enclose the mass, and no array is read.
  bool AreAroundSolid = false;
};

// A leaf of a composite data set.
struct Leaf
{
  vtkDataObject* Data;
  std::int64_t Number; // its flat index
  std::string Name;
  std::int64_t Whole; // that of the partitioned data set of which it is a piece, or its own

  // "block 3 ('name') of the input".
  std::string Text() const;
};
std::vector<Leaf> leavesOf(vtkCompositeDataSet* data);

// Leaves that are passed over since they are not data sets with cells, such as tables.
struct SkippedLeaves
{
  void Add(vtkDataObject* leaf, const std::string& name);
  // " (the first a vtkTable, block 2 of the input)"; empty without any.
  std::string FirstText() const
  {
    return this->First.empty() ? "" : " (the first a " + First + ")";
  }

  std::int64_t Count = 0;
  std::int64_t DataSets = 0; // the number of the leaves that are data sets
  std::string First;         // the class and the name of the first other one
};

// "1 block", "2 blocks".
std::string blocksText(std::int64_t count);

// Throws the Failure for what has `count` leaves, all of them skipped; `what` begins it.
[[noreturn]] void failSkipped(
  const std::string& what, std::int64_t count, const SkippedLeaves& skipped);

// The data sets with points: the object itself, or the leaves of a composite; the cells of hyper
// tree grids. AMR cells covered by finer ones are marked as refined. Other leaves are left out and
// recorded in `skipped`. Collective. Throws Failure as markRefinedCells, and Cancelled.
std::vector<DensityBlock> densityBlocks(vtkDataObject* data, SkippedLeaves* skipped = nullptr,
  Progress* progress = nullptr, const Ranks& ranks = SoloRanks::Get());

// Adds everything that a block's points and cells are made of, with ghost flags; and all arrays.
void addGeometry(const DensityBlock& block, DataIdentity& content);
void addArrays(const DensityBlock& block, DataIdentity& content);

} // namespace RectifiedTransport::Bridge

#endif
