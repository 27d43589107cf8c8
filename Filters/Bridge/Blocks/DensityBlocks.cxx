// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/DensityBlocks.h"

#include "Bridge/Blocks/HyperTreeCells.h"
#include "Bridge/Blocks/RefinedCells.h"
#include "Bridge/Data/Cells/CellTypes.h"
#include "Core/Messages/Failure.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkHyperTreeGrid.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkMatrix3x3.h"
#include "vtkOverlappingAMR.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>

namespace RectifiedTransport::Bridge
{

namespace
{

// Visits inner nodes, too. The AMR of VTK 9.6 is a tree whose iterator visits leaves alone.
vtkSmartPointer<vtkCompositeDataIterator> nodesOf(vtkCompositeDataSet* data)
{
  auto nodes = vtkSmartPointer<vtkCompositeDataIterator>::Take(data->NewIterator());
  auto* tree = vtkDataObjectTreeIterator::SafeDownCast(nodes);
  if (tree && !data->IsA("vtkAMRDataObject"))
  {
    tree->VisitOnlyLeavesOff();
  }
  return nodes;
}

// The newest of a data object's own and of all that are in it, whose arrays count.
// A composite data set is not modified when a program changes a block in place, so the times of its
// blocks decide, too. Inner nodes are visited since they change when a block is replaced.
std::uint64_t timeOf(vtkDataObject* data)
{
  vtkMTimeType newest = data ? data->GetMTime() : 0;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto nodes = nodesOf(composite);
    for (nodes->InitTraversal(); !nodes->IsDoneWithTraversal(); nodes->GoToNextItem())
    {
      newest = std::max(newest, nodes->GetCurrentDataObject()->GetMTime());
    }
  }
  return static_cast<std::uint64_t>(newest);
}

// The connectivity of one kind of cells: offsets (cells + 1 values) and point ids, as VTK 9 stores
// them. The time is that of the vtkCellArray, which owns both arrays.
void addCells(vtkCellArray* cells, DataIdentity& content)
{
  content.AddTimeOf(cells);
  content.AddArray(cells ? cells->GetOffsetsArray() : nullptr);
  content.AddArray(cells ? cells->GetConnectivityArray() : nullptr);
}

// Without an array of types (VTK may keep implicit ones) every grid with cells may have polyhedra.
// The faces of polyhedra do not follow from their points and are stored apart, so a grid that may
// have them needs more than its connectivity for its identity.
bool mayHavePolyhedra(vtkUnstructuredGrid* grid)
{
  auto* types = vtkUnsignedCharArray::SafeDownCast(cellTypesOf(grid));
  if (!types)
  {
    return grid->GetNumberOfCells() > 0;
  }
  const unsigned char* first = types->GetPointer(0);
  const unsigned char* last = first + types->GetNumberOfValues();
  return std::find(first, last, static_cast<unsigned char>(VTK_POLYHEDRON)) != last;
}

// The six bounds of a structured extent, in points. The cast keeps negative bounds distinct.
void addExtent(const int* extent, DataIdentity& content)
{
  for (int i = 0; i < 6; ++i)
  {
    content.AddNumber(static_cast<std::uint64_t>(extent[i]));
  }
}

} // namespace

std::string Leaf::Text() const
{
  return "block " + std::to_string(this->Number) +
    (!this->Name.empty() ? " ('" + this->Name + "')" : "") + " of the input";
}

// The iterator skips empty leaves. The flat index of a leaf counts empty ones, too, so that it is
// the same on all ranks, even if each has only some of the leaves.
std::vector<Leaf> leavesOf(vtkCompositeDataSet* data)
{
  std::vector<Leaf> leaves;
  const auto at = nodesOf(data);
  // The pieces of a partitioned data set have the indices after its own.
  std::int64_t whole = 0;
  std::int64_t lastPiece =
    vtkPartitionedDataSet::SafeDownCast(data) ? std::numeric_limits<std::int64_t>::max() : -1;
  for (at->InitTraversal(); !at->IsDoneWithTraversal(); at->GoToNextItem())
  {
    vtkDataObject* const object = at->GetCurrentDataObject();
    const std::int64_t index = at->GetCurrentFlatIndex();
    if (vtkDataObjectTree::SafeDownCast(object))
    {
      auto* const pieces = vtkPartitionedDataSet::SafeDownCast(object);
      whole = index;
      lastPiece = pieces ? index + pieces->GetNumberOfPartitions() : lastPiece;
      continue;
    }
    vtkInformation* about = at->HasCurrentMetaData() ? at->GetCurrentMetaData() : nullptr;
    const char* name = about ? about->Get(vtkCompositeDataSet::NAME()) : nullptr;
    leaves.push_back({ object, index, name ? name : "", index <= lastPiece ? whole : index });
  }
  return leaves;
}

void SkippedLeaves::Add(vtkDataObject* leaf, const std::string& name)
{
  if (this->Count++ == 0)
  {
    this->First = leaf->GetClassName() + (", " + name);
  }
}

std::string blocksText(std::int64_t count)
{
  return std::to_string(count) + (count == 1 ? " block" : " blocks");
}

void failSkipped(const std::string& what, std::int64_t count, const SkippedLeaves& skipped)
{
  throw Failure(what + " no image, mesh or grid, but " + blocksText(count) + " of another type" +
    skipped.FirstText());
}

// The data sets that have points, each with its name and number: hyper tree grids become meshes of
// their leaves, and cells of AMR grids that finer levels cover are marked as refined. Other leaves
// are counted, for messages.
std::vector<DensityBlock> densityBlocks(
  vtkDataObject* data, SkippedLeaves* skipped, Progress* progress, const Ranks& ranks)
{
  std::vector<DensityBlock> blocks;
  SkippedLeaves left;
  // Every block gets the time of the whole object: blocks may be new objects in each run, as
  // those of AMR grids and hyper tree grids are, whose own times say nothing about the input.
  const std::uint64_t time = timeOf(data);
  // All ranks take part, as this is collective: those whose data are no AMR, or have none, give
  // nullptr.
  const vtkSmartPointer<vtkCompositeDataSet> grids =
    markRefinedCells(vtkOverlappingAMR::SafeDownCast(data), ranks);
  auto* composite = grids ? grids.Get() : vtkCompositeDataSet::SafeDownCast(data);
  for (const Leaf& leaf :
    composite ? leavesOf(composite) : std::vector<Leaf>(1, Leaf{ data, 0, "", 0 }))
  {
    const std::string name = composite ? leaf.Text() : "input";
    vtkSmartPointer<vtkDataSet> set = vtkDataSet::SafeDownCast(leaf.Data);
    // A vtkHyperTreeGrid is no vtkDataSet, so its leaves become an unstructured grid that is.
    if (auto* trees = vtkHyperTreeGrid::SafeDownCast(leaf.Data))
    {
      set = cellsOfTrees(trees, progress);
    }
    if (leaf.Data && !set)
    {
      left.Add(leaf.Data, name);
    }
    left.DataSets += set ? 1 : 0;
    // Data sets without points are usual on ranks that have nothing of a block.
    if (set && set->GetNumberOfPoints() > 0)
    {
      blocks.push_back({ set, name, leaf.Number, time, nullptr, leaf.Whole });
    }
  }
  if (skipped)
  {
    *skipped = left;
  }
  return blocks;
}

// The identity of a geometry is that of all that its cells depend on: extents and transforms of
// grids, coordinates, connectivity, types, and ghost flags.
void addGeometry(const DensityBlock& block, DataIdentity& content)
{
  vtkDataSet* data = block.Data;
  content.AddTime(block.Time);
  content.AddNumber(static_cast<std::uint64_t>(data->GetDataObjectType()));
  content.AddNumber(static_cast<std::uint64_t>(data->GetNumberOfPoints()));
  content.AddNumber(static_cast<std::uint64_t>(data->GetNumberOfCells()));
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    content.AddArray(data->GetAttributes(owner)->GetArray(vtkDataSetAttributes::GhostArrayName()));
  }
  // Coordinates of meshes, 3 values a point. Images and rectilinear grids have none, but the
  // numbers from which VTK computes them.
  if (auto* points = vtkPointSet::SafeDownCast(data))
  {
    content.AddArray(points->GetPoints() ? points->GetPoints()->GetData() : nullptr);
  }
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    addExtent(image->GetExtent(), content);
    content.AddNumbers(image->GetOrigin(), 3);
    content.AddNumbers(image->GetSpacing(), 3);
    content.AddNumbers(image->GetDirectionMatrix()->GetData(), 9);
  }
  else if (auto* lattice = vtkRectilinearGrid::SafeDownCast(data))
  {
    addExtent(lattice->GetExtent(), content);
    for (vtkDataArray* coordinates :
      { lattice->GetXCoordinates(), lattice->GetYCoordinates(), lattice->GetZCoordinates() })
    {
      content.AddArray(coordinates);
    }
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(data))
  {
    addExtent(structured->GetExtent(), content);
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    addCells(grid->GetCells(), content);
    content.AddArray(cellTypesOf(grid));
    if (mayHavePolyhedra(grid))
    {
      // Their faces are in no array that all versions of VTK give.
      content.AddNumber(block.Time);
    }
  }
  else if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    // Vertices are left out: cells of no length or area have no part in a density.
    for (vtkCellArray* cells : { surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
    {
      addCells(cells, content);
    }
  }
  else
  {
    // How its cells are kept is not known.
    content.AddNumber(static_cast<std::uint64_t>(data->GetMTime()));
  }
}

// All arrays count, and which are active, for results that pass arrays on, such as joined images.
void addArrays(const DensityBlock& block, DataIdentity& content)
{
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = block.Data->GetAttributes(owner);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      content.AddArray(attributes->GetAbstractArray(i));
      content.AddNumber(static_cast<std::uint64_t>(attributes->IsArrayAnAttribute(i)));
    }
  }
}

} // namespace RectifiedTransport::Bridge
