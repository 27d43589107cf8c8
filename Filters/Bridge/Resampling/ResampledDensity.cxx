// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/ResampledDensity.h"

#include "Bridge/Density/DensityFailure.h"
#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/FilledCells.h"
#include "Bridge/Image/DefaultArray.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Lattices/JoinedImages.h"
#include "Bridge/Lattices/PlacesInLattice.h"
#include "Bridge/Meshes/MeshGrid.h"
#include "Bridge/Meshes/RegionShapes.h"
#include "Bridge/Points/SampledArrays.h"
#include "Bridge/Resampling/MeshDensity.h"
#include "Bridge/Resampling/PlacesInMeshes.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/DensityInspection.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace RectifiedTransport::Bridge
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

DataContent contentOf(const DensityBlocks& blocks, int resolution, const DensityRules& rules)
{
  // Images may be joined, with all their arrays.
  const bool mayJoin = blocks.All.size() > 1 &&
    std::all_of(blocks.All.begin(), blocks.All.end(),
      [](const DensityBlock& block) { return vtkImageData::SafeDownCast(block.Data) != nullptr; });
  DataContent content;
  for (const DensityBlock& block : blocks.All)
  {
    addGeometry(block, content);
    content.AddArray(block.Array);
    if (mayJoin)
    {
      addArrays(block, content);
    }
  }
  for (const int number : { blocks.OnPoints ? 1 : 0, blocks.Dimension, resolution, rules.Component,
         rules.Invert ? 1 : 0, rules.ClampNegative ? 1 : 0, rules.Missing.AreNaN ? 1 : 0,
         static_cast<int>(rules.Empty.Cells) })
  {
    content.AddNumber(static_cast<std::uint64_t>(number));
  }
  const double numbers[] = { rules.Missing.Low, rules.Missing.High, rules.Empty.Value };
  content.AddNumbers(numbers, 3);
  return content;
}

// Adds what is known about a block's values. `isBeyond`: its value replaces that of the blocks
// before. Blocks number their values each from 0: the index stays that of the block of this name.
template <class Found>
void addBlock(const BlockValues& block, const Found& part, std::int64_t Found::*index,
  bool isBeyond, Found& all, std::string& name)
{
  const std::int64_t first = all.*index;
  merge(part, all);
  if (name.empty() || isBeyond)
  {
    name = block.Name();
    return;
  }
  all.*index = first;
}

std::vector<std::string> describeBlocks(const std::vector<BlockValues>& blocks,
  const ImageGrid& grid, const DensityRules& rules, Progress& progress)
{
  UnusualValues all;
  ValuePlaces places{ {}, {}, {}, blocks.front().IsOnPoints() ? "points" : "cells", 0, rules.Invert,
    isOfSeveral(rules), fillValuesOf(blocks.front().Data()->GetFieldData()) };
  for (const BlockValues& block : blocks)
  {
    const UnusualValues& known = block.Unusual();
    addBlock(block, known.Found, &DensitySummary::FirstMaximum,
      known.Found.Maximum > all.Found.Maximum, all.Found, places.Largest);
    addBlock(block, known.White, &LargestValue::First, known.White.Value > all.White.Value,
      all.White, places.White);
    addBlock(block, known.Clamped, &LowestValue::First, known.Clamped.Value < all.Clamped.Value,
      all.Clamped, places.Lowest);
    places.All += block.NumberOfValues();
  }
  const double largest = all.Found.Maximum;
  return describeUnusual(all, places, [&]() {
    std::vector<BlockValues> only;
    only.reserve(blocks.size());
    for (const BlockValues& block : blocks)
    {
      only.push_back(block.Only(largest));
    }
    return integralOf(only, grid, progress) / integralOf(blocks, grid, progress);
  });
}

} // namespace

// The image that data sets were resampled to. Its values are densities, with the rules applied.
// Particles get their arrays from the data sets.
class ResampledDensity::Density final : public DensityImage
{
public:
  explicit Density(const ResampledDensity& made)
    : DensityImage(made.Image, made.Image->GetCellData()->GetScalars(), false, DensityRules())
    , Made(made)
  {
    this->Empty = made.Empty;
    this->Read = made.How;
  }

  void SampleArrays(const Extent& /*extent*/, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const override
  {
    const std::vector<BlockValues>& meshes = this->Made.Meshes;
    Stages stages(progress, { { "places", 1 }, { "arrays", 1 } });
    ArraySource source{ {}, "input", false };
    for (const BlockValues& mesh : meshes)
    {
      source.Sets.push_back(mesh.Data());
    }
    if (this->Made.Lattice)
    {
      const PlacesInLattice places(*this->Made.Lattice, meshes, particles, stages["places"]);
      sampleArrays(source, places, stages["arrays"], output);
      return;
    }
    const PlacesInMeshes places(meshes, this->Grid(), particles, stages["places"]);
    sampleArrays(source, places, stages["arrays"], output);
  }

private:
  std::vector<std::string> Describe(const UnusualValues& /*values*/) const override
  {
    return this->Made.Unusual;
  }

  const ResampledDensity& Made;
};

std::unique_ptr<InputDensity> ResampledDensity::Read(
  const DensityBlocks& blocks, int resolution, const DensityRules& rules, Progress& progress)
{
  DataContent content = contentOf(blocks, resolution, rules);
  if (!content.IsSameAs(this->Content, progress))
  {
    *this = ResampledDensity();
    this->Image = joinImages(blocks.All, blocks.OnPoints);
    if (!this->Image)
    {
      this->Resample(blocks, resolution, rules, progress);
    }
    content.Keep(progress);
    this->Content = std::move(content);
  }
  // The data sets may be new ones with the same content.
  const std::vector<DensityBlock> read = withMass(blocks.All);
  if (!this->Meshes.empty())
  {
    for (std::size_t b = 0; b < read.size(); ++b)
    {
      this->Meshes[b].SetData(read[b].Data);
    }
    return std::make_unique<Density>(*this);
  }
  vtkDataArray* array = read.front().Array;
  if (blocks.All.size() == 1)
  {
    this->Image = vtkImageData::SafeDownCast(read.front().Data);
  }
  else
  {
    array = attributesOf(this->Image, blocks.OnPoints)->GetScalars();
  }
  return std::make_unique<DensityImage>(this->Image, array, blocks.OnPoints, rules);
}

void ResampledDensity::Resample(
  const DensityBlocks& blocks, int resolution, const DensityRules& rules, Progress& progress)
{
  // A mesh is checked by meshGrid before its values are read.
  const MassCells cells = massCells(blocks.All, blocks.Dimension, progress);
  if (!cells.AreClosedLines)
  {
    this->Lattice = CellLattice::Find(blocks.All, blocks.Dimension, progress);
  }
  ImageGrid grid = !this->Lattice ? meshGrid(blocks.All, cells, resolution, progress)
    : blocks.OnPoints             ? this->Lattice->DividedGrid(resolution)
                                  : this->Lattice->Grid();
  const std::vector<DensityBlock> read = withMass(blocks.All);
  DensityRules taken = rules;
  taken.Component = takenComponent(read, rules.Component);
  this->Meshes = readBlocks(read, blocks.OnPoints, cells, rules, progress);
  if (this->Lattice && !this->Lattice->HasEachOnce(this->Meshes, progress))
  {
    this->Lattice.reset();
    grid = meshGrid(blocks.All, cells, resolution, progress);
  }
  if (!this->Lattice && cells.Dimension == 2)
  {
    markRegions(this->Meshes, grid, progress);
  }
  const bool isLatticeImage = this->Lattice && !blocks.OnPoints;
  requireMemory("an image of " + describeValues(grid) +
      (isLatticeImage ? " cells" : " cells (see DensityResolution)"),
    numberOfValues(grid) * sizeof(double));
  this->Image = vtkSmartPointer<vtkImageData>::New();
  applyGrid(grid, this->Image);
  vtkDataArray* first = read.front().Array;
  const char* name = first->GetName();
  this->How = readingBy(taken, name ? name : "", first->GetNumberOfComponents());
  const auto density = newArray<vtkDoubleArray>(
    name ? name : "Density", 1, static_cast<vtkIdType>(grid.NumberOfCells()));
  this->Lost = this->ValuesOn(grid, this->Meshes, progress, density->GetPointer(0));
  if (rules.Empty.Cells != EmptyCells::Zero)
  {
    this->FillEmpty(grid, rules.Empty, progress, density->GetPointer(0));
  }
  this->Image->GetCellData()->SetScalars(density);
  this->Unusual = describeBlocks(this->Meshes, grid, taken, progress);
}

// The mean of the blocks' densities over each cell of the grid.
std::vector<std::string> ResampledDensity::ValuesOn(const ImageGrid& grid,
  const std::vector<BlockValues>& blocks, Progress& progress, double* values) const
{
  if (this->Lattice && !blocks.front().IsOnPoints())
  {
    this->Lattice->CopyValues(blocks, values, progress);
    return {};
  }
  std::vector<std::string> warnings = resampleCells(blocks, grid, progress, values);
  if (this->Lattice)
  {
    this->Lattice->ClearAround(blocks, grid, values, progress);
  }
  return warnings;
}

// Adds the density of the part of each cell that no counted cell covers.
void ResampledDensity::FillEmpty(
  const ImageGrid& grid, const EmptyRule& rule, Progress& progress, double* values)
{
  std::vector<BlockValues> ground;
  FilledCells filled;
  for (const BlockValues& block : this->Meshes)
  {
    ground.push_back(block.Ground());
    filled.Least = std::min(filled.Least, block.Least());
  }
  LargeBuffer<double> covered;
  withMemory("what the input's cells cover", numberOfValues(grid) * sizeof(double),
    [&]() { covered = LargeBuffer<double>(grid.NumberOfCells()); });
  this->ValuesOn(grid, ground, progress, covered.data());
  constexpr double rounding = 1e-9;
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const auto shareOf = [&covered](std::int64_t cell) {
    const double share = covered.data()[cell]; // more than 1 where cells overlap
    return share > 1.0 - rounding ? 1.0 : share;
  };
  filled.Add(sumExactly<FilledCells>(progress, grid.NumberOfCells(), grain,
    [&](std::int64_t first, std::int64_t last, FilledCells& part) {
      for (std::int64_t cell = first; cell < last; ++cell)
      {
        part.Mass.Add(values[cell]);
        part.Cells.Add(shareOf(cell));
      }
    }));
  this->Empty = densityOfEmptyCells(rule, filled);
  progress.For(grid.NumberOfCells(), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t cell = first; cell < last; ++cell)
    {
      values[cell] += (1.0 - shareOf(cell)) * this->Empty;
    }
  });
}

} // namespace RectifiedTransport::Bridge
