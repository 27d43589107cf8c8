// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cells/ResampledDensity.h"

#include "Bridge/Blocks/JoinedImages.h"
#include "Bridge/Cells/CellSampling.h"
#include "Bridge/Data/DefaultArray.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Density/ArrayReader.h"
#include "Bridge/Density/DensityImage.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Triangles/SolidDensity.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Resampling/CellFrame.h"
#include "Core/Resampling/CellSums.h"
#include "Core/Resampling/Reading/SetMessages.h"
#include "Core/Resampling/RegionShapes.h"
#include "Core/Tables/Reading/OccupiedCells.h"
#include "Surfaces/Solid/SolidCoverage.h"

#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// The blocks that have the array. The others only enlarge the domain.
std::vector<DensityBlock> withMass(const std::vector<DensityBlock>& blocks)
{
  std::vector<DensityBlock> with;
  std::copy_if(blocks.begin(), blocks.end(), std::back_inserter(with),
    [](const DensityBlock& block) { return block.Array != nullptr; });
  return with;
}

// What the image depends on: geometries, the array of each block, the resolution and the rules.
// Other arrays do not change a resampled density, whose particles get theirs from the current data
// sets.
DataIdentity contentOf(const DensityBlocks& blocks, int resolution, const DensityRules& rules)
{
  // Images may be joined, with all their arrays.
  const bool mayJoin = blocks.All.size() > 1 &&
    std::all_of(blocks.All.begin(), blocks.All.end(),
      [](const DensityBlock& block) { return vtkImageData::SafeDownCast(block.Data) != nullptr; });
  DataIdentity content;
  for (const DensityBlock& block : blocks.All)
  {
    addGeometry(block, content);
    content.AddArray(block.Array);
    if (mayJoin)
    {
      addArrays(block, content);
    }
  }
  for (const int number : { blocks.OnPoints ? 1 : 0, blocks.Dimension, resolution })
  {
    content.AddNumber(static_cast<std::uint64_t>(number));
  }
  content.AddRules(rules);
  return content;
}

} // namespace

// The image that data sets were resampled to, whose values are densities with the rules applied; or
// the one of a solid, whose values the rules are for. Particles get their arrays from the data
// sets; surfaces have none for what they enclose.
class ResampledDensity::Density final : public DensityImage
{
public:
  explicit Density(const ResampledDensity& made, const DensityRules& rules = DensityRules())
    : DensityImage(made.Image, made.Image->GetCellData()->GetScalars(), false, rules)
    , Made(made)
  {
    this->Empty = made.Empty;
    this->Read = made.How;
  }

  void SampleArrays(const Extent& /*extent*/, ConstPointSpan<3> particles, Progress& progress,
    vtkPointData* output) const override
  {
    if (!this->Made.Surface)
    {
      sampleCells(this->Made.Blocks, this->Made.Lattice, this->Grid(), particles, progress, output);
    }
  }

  void MoveInside(PointSpan<3> particles, Progress& progress) const override
  {
    if (this->Made.Surface && !this->Rules.Invert)
    {
      moveInside(this->Made.Surface->Triangles(), particles, progress);
    }
  }

private:
  std::vector<std::string> Describe(const SuspectValues& /*values*/) const override
  {
    return this->Made.Suspect;
  }

  const ResampledDensity& Made;
};

std::unique_ptr<InputDensity> ResampledDensity::Read(
  const DensityBlocks& blocks, int resolution, const DensityRules& rules, Progress& progress)
{
  // Four results: one image stays as it is, images that tile a lattice are joined, surfaces that
  // lie in no plane are filled, and all other data are resampled. Only the last one has Blocks and
  // applies the rules to the values itself.
  DataIdentity content = contentOf(blocks, resolution, rules);
  if (!content.IsSameAs(this->Content, progress))
  {
    // Releases the last image before memory for the next one is needed.
    *this = ResampledDensity();
    this->Image = joinImages(blocks.All, blocks.OnPoints); // nullptr for other data
    if (blocks.AreAroundSolid)
    {
      this->FillSurfaces(blocks.All, resolution, progress);
    }
    else if (!this->Image)
    {
      this->Resample(blocks, resolution, rules, progress);
    }
    content.Hash(progress);
    this->Content = std::move(content);
  }
  if (blocks.AreAroundSolid)
  {
    this->How = readingBy(rules, "", 1); // no array is read
    this->How.Component = 0;
    return std::make_unique<Density>(*this, rules);
  }
  // The data sets may be new ones with the same content.
  const std::vector<DensityBlock> read = withMass(blocks.All);
  if (!this->Blocks.Cells.empty())
  {
    const CellSets sets = cellSetsOf(read);
    for (std::size_t b = 0; b < read.size(); ++b)
    {
      this->Blocks.Cells[b].SetCells(sets[b]);
      this->Blocks.Data[b] = read[b].Data;
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

// Makes the image of Solid Density, in the bounds of the surfaces: the covered fraction of each
// cell.
void ResampledDensity::FillSurfaces(
  const std::vector<DensityBlock>& surfaces, int resolution, Progress& progress)
{
  // Those of all blocks and ranks are one solid. Their arrays play no part, whatever their lengths.
  vtkNew<vtkAppendPolyData> all;
  for (const DensityBlock& block : surfaces)
  {
    vtkNew<vtkPolyData> surface;
    surface->CopyStructure(block.Data);
    all->AddInputData(surface);
  }
  all->Update();
  SolidDensity solid{ resolution, 2, 0.0, false, false };
  solid.OpenAdvice =
    "Sample Surface puts particles on an open surface; Solid Density with OpenSurfaces "
    "WindingNumber makes a density of it, for particles inside. ";
  solid.ResolutionName = "DensityResolution";
  this->Image = vtkSmartPointer<vtkImageData>::New();
  const SolidDensityReport report = solid.Run(
    all->GetOutput(), [](const ImageGrid& grid) { return grid.Extent(); }, progress, this->Image);
  this->Surface = report.Surface;
  this->Lost.assign(report.Repair.empty() ? 0 : 1, report.Repair);
}

void ResampledDensity::Resample(
  const DensityBlocks& blocks, int resolution, const DensityRules& rules, Progress& progress)
{
  // A mesh is checked by its frame before its values are read.
  const CellSets sets = cellSetsOf(blocks.All);
  const MassCells mass = massCells(sets, blocks.Dimension, progress);
  // Cells that a filter such as Threshold made of an image have the values of its cells: on the
  // lattice they return to their places, without any rounding by overlaps.
  if (!mass.AreClosedLines)
  {
    this->Lattice = latticeOf(blocks.All, sets, blocks.Dimension, progress);
  }
  // Point values vary within a cell, which only a finer grid shows: the cells of the lattice are
  // divided for them. Other data get a grid of cubes as nearly as their box allows.
  ImageGrid grid = !this->Lattice ? CellFrame::Of(sets, mass, progress).Grid(resolution)
    : blocks.OnPoints             ? this->Lattice->DividedGrid(resolution)
                                  : this->Lattice->Grid();
  const std::vector<DensityBlock> read = withMass(blocks.All);
  DensityRules taken = rules;
  taken.Component = commonComponent(read, rules.Component);
  this->Blocks = readBlocks(read, cellSetsOf(read), blocks.OnPoints, mass, rules, progress);
  // Two counted cells in one place: overlapping data sets add up, which a copy of values cannot do.
  if (this->Lattice && !this->Lattice->HasEachOnce(this->Blocks.Cells, progress))
  {
    this->Lattice.reset();
    grid = CellFrame::Of(sets, mass, progress).Grid(resolution);
  }
  // Polygons of any shape are filled by the even-odd rule where division into triangles would be
  // wrong.
  if (!this->Lattice && mass.Dimension == 2)
  {
    markRegions(this->Blocks.Cells, grid, progress);
  }
  const bool isLatticeImage = this->Lattice && !blocks.OnPoints;
  requireMemory({ "an image of " + describeValues(grid) +
      (isLatticeImage ? " cells" : " cells (see DensityResolution)"),
    numberOfValues(grid) * sizeof(double) });
  this->Image = vtkSmartPointer<vtkImageData>::New();
  // After the check of memory, as applyGrid allocates coordinates from VTK 9.3 on.
  applyGrid(grid, this->Image);
  vtkDataArray* first = read.front().Array;
  const char* name = first->GetName();
  this->How = readingBy(taken, name ? name : "", first->GetNumberOfComponents());
  // One density a cell of the grid, in mass per length, area or volume; axis 0 fastest.
  const auto density = newArray<vtkDoubleArray>(
    name ? name : "Density", 1, static_cast<vtkIdType>(grid.NumberOfCells()));
  const CellSize size = this->AddCells(grid, this->Blocks.Cells, progress, density->GetPointer(0));
  // Cells that VTK cannot divide carry no mass. The warning says how much that is at most.
  this->Lost = describeLost(this->Blocks.Cells, size, grid.Dimension());
  if (rules.Empty.Cells != EmptyCells::Zero)
  {
    this->FillEmpty(grid, rules.Empty, progress, density->GetPointer(0));
  }
  // The rules were applied to the input's values: applied to their means they would give another
  // density.
  this->Image->GetCellData()->SetScalars(density);
  const ValuePlaces places{ {}, {}, {}, blocks.OnPoints ? "points" : "cells", 0, taken.Invert,
    taken.IsOfSeveral(), fillValuesOf(read.front().Data->GetFieldData()) };
  this->Suspect =
    describeSuspect(this->Blocks.Cells, this->Blocks.Findings, places, grid, progress);
}

// Writes the mean of the cells' densities over each cell of the grid.
CellSize ResampledDensity::AddCells(const ImageGrid& grid, const std::vector<CellValues>& cells,
  Progress& progress, double* values) const
{
  if (this->Lattice && !cells.front().IsOnPoints())
  {
    this->Lattice->CopyValues(cells, values, progress);
    return {};
  }
  const CellSize size = withMemory({ "the order of the input's cells", 0.0 },
    [&]() { return resampleCells(cells, grid, progress, values); });
  if (this->Lattice)
  {
    this->Lattice->ClearAround(cells, grid, values, progress);
  }
  return size;
}

// Adds the density of the part of each cell that no counted cell covers.
void ResampledDensity::FillEmpty(
  const ImageGrid& grid, const EmptyRule& rule, Progress& progress, double* values)
{
  std::vector<CellValues> ground;
  for (const CellValues& cells : this->Blocks.Cells)
  {
    ground.push_back(cells.Ground());
  }
  // The part of each cell of the grid that the counted cells cover, in [0, 1] up to rounding and
  // more where they overlap: the mean of the density 1.
  LargeBuffer<double> covered;
  withMemory({ "what the input's cells cover", numberOfValues(grid) * sizeof(double) },
    [&]() { covered = LargeBuffer<double>(grid.NumberOfCells()); });
  this->AddCells(grid, ground, progress, covered.data());
  OccupiedCells filled;
  // The least value of the input's cells, not of the grid's: means along borders are smaller.
  for (const SetFindings& set : this->Blocks.Findings)
  {
    filled.Least = std::min(filled.Least, set.Least);
  }
  this->Empty =
    fillEmptyParts(covered.data(), grid.NumberOfCells(), filled, rule, progress, values);
}

} // namespace RectifiedTransport::Bridge
