// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/ResampledDensity.h"

#include "Bridge/Lattices/CellLattice.h"
#include "Bridge/Lattices/JoinedImages.h"
#include "Bridge/Meshes/MeshGrid.h"
#include "Bridge/Meshes/RegionShapes.h"
#include "Bridge/Resampling/MeshDensity.h"
#include "Bridge/Resampling/UnusualBlocks.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

namespace RectifiedTransport
{

namespace
{

std::vector<DensityBlock> withMass(const std::vector<DensityBlock>& blocks)
{
  std::vector<DensityBlock> with;
  std::copy_if(blocks.begin(), blocks.end(), std::back_inserter(with),
    [](const DensityBlock& block) { return block.Array != nullptr; });
  return with;
}

const char* nameOfArray(const std::vector<DensityBlock>& blocks)
{
  const auto with = std::find_if(
    blocks.begin(), blocks.end(), [](const DensityBlock& block) { return block.Array != nullptr; });
  return with->Array->GetName();
}

DataContent contentOf(const std::vector<DensityBlock>& blocks)
{
  // Images may be joined, with all their arrays.
  const bool areImages = std::all_of(blocks.begin(), blocks.end(),
    [](const DensityBlock& block) { return vtkImageData::SafeDownCast(block.Data) != nullptr; });
  DataContent content;
  for (const DensityBlock& block : blocks)
  {
    addGeometry(block, content);
    content.AddArray(block.Array);
    for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkDataSetAttributes* attributes = block.Data->GetAttributes(owner);
      for (int i = 0; areImages && blocks.size() > 1 && i < attributes->GetNumberOfArrays(); ++i)
      {
        content.AddArray(attributes->GetAbstractArray(i));
      }
    }
  }
  return content;
}

} // namespace

vtkImageData* ResampledDensity::Image() const
{
  return this->Made;
}

void ResampledDensity::Update(const std::vector<DensityBlock>& blocks, bool onPoints, int dimension,
  int resolution, const DensityRules& rules, Progress& progress)
{
  DataContent content = contentOf(blocks);
  for (const int number : { onPoints ? 1 : 0, dimension, resolution, rules.Component,
         rules.Invert ? 1 : 0, rules.ClampNegative ? 1 : 0 })
  {
    content.AddNumber(static_cast<std::uint64_t>(number));
  }
  if (this->Made && content.IsSameAs(this->Content, progress))
  {
    this->Attach(blocks);
    return;
  }
  *this = ResampledDensity();
  if (!this->Join(blocks, onPoints))
  {
    this->Resample(blocks, onPoints, dimension, resolution, rules, progress);
  }
  content.Keep(progress);
  this->Content = std::move(content);
}

// Returns whether the blocks are images that tile a lattice.
bool ResampledDensity::Join(const std::vector<DensityBlock>& blocks, bool onPoints)
{
  this->Made = joinImages(blocks, onPoints);
  if (!this->Made)
  {
    return false;
  }
  this->OnPoints = onPoints;
  vtkDataSetAttributes* attributes =
    this->Made->GetAttributes(onPoints ? vtkDataObject::POINT : vtkDataObject::CELL);
  this->Density =
    blocks.size() == 1 ? blocks.front().Array : attributes->GetArray(nameOfArray(blocks));
  return true;
}

void ResampledDensity::Resample(const std::vector<DensityBlock>& blocks, bool onPoints,
  int dimension, int resolution, const DensityRules& rules, Progress& progress)
{
  // A mesh is checked by meshGrid before its values are read.
  const MassCells cells = massCells(blocks, dimension, progress);
  std::shared_ptr<const CellLattice> lattice;
  if (!cells.AreClosedLines)
  {
    if (std::optional<CellLattice> found = CellLattice::Find(blocks, dimension, progress))
    {
      lattice = std::make_shared<const CellLattice>(std::move(*found));
    }
  }
  ImageGrid grid = !lattice ? meshGrid(blocks, cells, resolution, progress)
    : onPoints              ? lattice->DividedGrid(resolution)
                            : lattice->Grid();
  this->Blocks = readBlocks(withMass(blocks), onPoints, cells, rules, progress);
  if (lattice && !lattice->HasEachOnce(this->Blocks, progress))
  {
    lattice.reset();
    grid = meshGrid(blocks, cells, resolution, progress);
  }
  const char* name = nameOfArray(blocks);
  const char* called = name ? name : "Density";
  if (lattice && !onPoints)
  {
    this->Made = lattice->MakeImage(this->Blocks, called, progress);
  }
  else
  {
    if (!lattice && cells.Dimension == 2)
    {
      markRegions(this->Blocks, grid, progress);
    }
    const MeshDensity made = MeshDensity::Make(this->Blocks, grid, called, progress);
    this->Made = made.Image;
    this->Lost = made.Warnings;
  }
  this->Density = this->Made->GetCellData()->GetScalars();
  if (lattice && onPoints)
  {
    auto* values = vtkDoubleArray::SafeDownCast(this->Density);
    lattice->ClearAround(this->Blocks, grid, values->GetPointer(0), progress);
  }
  for (BlockValues& block : this->Blocks)
  {
    block.SetLattice(lattice);
  }
  this->Resampled = true;
  this->Unusual = describeUnusual(this->Blocks, grid, rules.Invert, progress);
}

// The data sets may be new ones with the same content.
void ResampledDensity::Attach(const std::vector<DensityBlock>& blocks)
{
  if (!this->Resampled && blocks.size() == 1)
  {
    this->Made = vtkImageData::SafeDownCast(blocks.front().Data);
    this->Density = blocks.front().Array;
  }
  const std::vector<DensityBlock> read = withMass(blocks);
  for (std::size_t b = 0; b < this->Blocks.size(); ++b)
  {
    this->Blocks[b].SetData(read[b].Data);
  }
}

} // namespace RectifiedTransport
