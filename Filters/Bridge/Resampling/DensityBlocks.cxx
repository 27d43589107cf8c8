// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/DensityBlocks.h"

#include "Bridge/Run/Failure.h"

#include "vtkAMRUtilities.h"
#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkOverlappingAMR.h"
#include "vtkUniformGrid.h"

#include <algorithm>
#include <array>

namespace RectifiedTransport
{

namespace
{

std::string nameOfBlock(vtkCompositeDataIterator* leaves)
{
  std::string name = "block " + std::to_string(leaves->GetCurrentFlatIndex());
  vtkInformation* information =
    leaves->HasCurrentMetaData() ? leaves->GetCurrentMetaData() : nullptr;
  if (information && information->Has(vtkCompositeDataSet::NAME()))
  {
    name += " ('" + std::string(information->Get(vtkCompositeDataSet::NAME())) + "')";
  }
  return name + " of the input";
}

bool hasGhosts(vtkOverlappingAMR* grids)
{
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(grids->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    auto* data = vtkDataSet::SafeDownCast(leaves->GetCurrentDataObject());
    if (data && data->GetCellGhostArray())
    {
      return true;
    }
  }
  return false;
}

// Of its own grids: marking would write into those of the input.
vtkSmartPointer<vtkOverlappingAMR> withRefinedMarked(vtkOverlappingAMR* grids)
{
  const auto marked = vtkSmartPointer<vtkOverlappingAMR>::New();
  marked->CopyStructure(grids);
  for (unsigned int level = 0; level < grids->GetNumberOfLevels(); ++level)
  {
    for (unsigned int i = 0; i < grids->GetNumberOfDataSets(level); ++i)
    {
      if (vtkUniformGrid* grid = grids->GetDataSet(level, i))
      {
        vtkNew<vtkUniformGrid> copy;
        copy->ShallowCopy(grid);
        marked->SetDataSet(level, i, copy);
      }
    }
  }
  vtkAMRUtilities::BlankCells(marked);
  return marked;
}

std::array<int, VTK_NUMBER_OF_CELL_TYPES> dimensionsOfTypes()
{
  std::array<int, VTK_NUMBER_OF_CELL_TYPES> dimensions;
  for (int type = 0; type < VTK_NUMBER_OF_CELL_TYPES; ++type)
  {
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    dimensions[static_cast<std::size_t>(type)] = cell ? cell->GetCellDimension() : 0;
  }
  return dimensions;
}

int largestDimension(vtkDataSet* data)
{
  int largest = 0;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells() && largest < 3; ++cell)
  {
    largest = std::max(largest, dimensionOfCellType(data->GetCellType(cell)));
  }
  return largest;
}

} // namespace

std::vector<DensityBlock> densityBlocks(vtkDataObject* data)
{
  std::vector<DensityBlock> blocks;
  const auto add = [&blocks](vtkDataObject* object, const std::string& name, vtkMTimeType time) {
    auto* set = vtkDataSet::SafeDownCast(object);
    if (object && !set)
    {
      throw Failure("The density has a block of type " + std::string(object->GetClassName()) +
        ", " + name + "; it must be a data set of cells: Extract Block leaves it out");
    }
    if (set && set->GetNumberOfPoints() > 0)
    {
      blocks.push_back({ set, name, time });
    }
  };
  vtkSmartPointer<vtkCompositeDataSet> composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    add(data, "input", data ? data->GetMTime() : 0);
    return blocks;
  }
  auto* grids = vtkOverlappingAMR::SafeDownCast(data);
  if (grids && grids->GetNumberOfLevels() > 1 && !hasGhosts(grids))
  {
    composite = withRefinedMarked(grids);
  }
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    vtkDataObject* own = vtkCompositeDataSet::SafeDownCast(data)->GetDataSet(leaves);
    add(leaves->GetCurrentDataObject(), nameOfBlock(leaves), own->GetMTime());
  }
  return blocks;
}

int dimensionOfCellType(int type)
{
  static const std::array<int, VTK_NUMBER_OF_CELL_TYPES> dimensions = dimensionsOfTypes();
  return type >= 0 && type < VTK_NUMBER_OF_CELL_TYPES ? dimensions[static_cast<std::size_t>(type)]
                                                      : 0;
}

int largestCellDimension(const std::vector<DensityBlock>& blocks)
{
  int largest = 0;
  for (const DensityBlock& block : blocks)
  {
    largest = std::max(largest, largestDimension(block.Data));
  }
  return largest;
}

void keepBlocksOfDimension(int dimension, std::vector<DensityBlock>& blocks)
{
  blocks.erase(
    std::remove_if(blocks.begin(), blocks.end(),
      [=](const DensityBlock& block) { return largestDimension(block.Data) < dimension; }),
    blocks.end());
}

} // namespace RectifiedTransport
