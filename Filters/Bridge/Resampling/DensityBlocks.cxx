// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/DensityBlocks.h"

#include "Bridge/Run/Failure.h"

#include "vtkAMRUtilities.h"
#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkOverlappingAMR.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUniformGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstring>

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

// The time of a data set itself does not do: in ParaView it is new at every run.
std::vector<std::uint64_t> geometryOf(vtkDataSet* data)
{
  std::vector<std::uint64_t> stamp{ static_cast<std::uint64_t>(data->GetDataObjectType()),
    static_cast<std::uint64_t>(data->GetNumberOfPoints()),
    static_cast<std::uint64_t>(data->GetNumberOfCells()) };
  const auto add = [&stamp](vtkObject* object) {
    stamp.push_back(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(object)));
    stamp.push_back(object ? static_cast<std::uint64_t>(object->GetMTime()) : 0);
  };
  const auto addNumbers = [&stamp](const double* numbers, int count) {
    for (int i = 0; i < count; ++i)
    {
      stamp.emplace_back();
      std::memcpy(&stamp.back(), numbers + i, sizeof(double));
    }
  };
  const auto addExtent = [&stamp](
                           const int* extent) { stamp.insert(stamp.end(), extent, extent + 6); };
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data->GetAttributes(owner);
    if (auto* flags = attributes->GetArray(vtkDataSetAttributes::GhostArrayName()))
    {
      add(flags);
    }
  }
  if (auto* points = vtkPointSet::SafeDownCast(data))
  {
    add(points->GetPoints() ? points->GetPoints()->GetData() : nullptr);
  }
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    addExtent(image->GetExtent());
    addNumbers(image->GetOrigin(), 3);
    addNumbers(image->GetSpacing(), 3);
    addNumbers(image->GetDirectionMatrix()->GetData(), 9);
  }
  else if (auto* lattice = vtkRectilinearGrid::SafeDownCast(data))
  {
    addExtent(lattice->GetExtent());
    add(lattice->GetXCoordinates());
    add(lattice->GetYCoordinates());
    add(lattice->GetZCoordinates());
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(data))
  {
    addExtent(structured->GetExtent());
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    add(grid->GetCells());
    add(grid->GetCellTypesArray());
  }
  else if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    for (vtkCellArray* cells : { surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
    {
      add(cells);
    }
  }
  else
  {
    add(data);
  }
  return stamp;
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
  const auto add = [&blocks](vtkDataObject* object, const std::string& name, std::int64_t number) {
    auto* set = vtkDataSet::SafeDownCast(object);
    if (object && !set)
    {
      throw Failure("The density has a block of type " + std::string(object->GetClassName()) +
        ", " + name + "; it must be a data set of cells: Extract Block leaves it out");
    }
    if (set && set->GetNumberOfPoints() > 0)
    {
      blocks.push_back({ set, name, number, geometryOf(set) });
    }
  };
  vtkSmartPointer<vtkCompositeDataSet> composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    add(data, "input", 0);
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
    add(leaves->GetCurrentDataObject(), nameOfBlock(leaves), leaves->GetCurrentFlatIndex());
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
