// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cells/BlockValues.h"

#include "Bridge/Data/Cells/MeshCells.h"
#include "Bridge/Density/ArrayReader.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/Settings/ComponentChoice.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

std::string nameOf(const DensityBlock& block)
{
  return describeArray(block.Array) + " of the " + block.Name;
}

DensityRules rulesOf(const DensityBlock& block, const DensityRules& rules)
{
  return resolveRules(block.Array, nameOf(block), rules);
}

} // namespace

CellSets cellSetsOf(const std::vector<DensityBlock>& blocks)
{
  CellSets sets;
  for (const DensityBlock& block : blocks)
  {
    sets.push_back(std::make_shared<MeshCells>(block.Data, block.Name));
  }
  return sets;
}

std::optional<CellLattice> latticeOf(
  const std::vector<DensityBlock>& blocks, const CellSets& sets, int dimension, Progress& progress)
{
  std::optional<CellLattice> lattice = CellLattice::Find(sets, dimension, progress);
  for (std::size_t b = 0; lattice && b < sets.size(); ++b)
  {
    const bool isPlaced =
      withMemory({ "the places of cells in their lattice",
                   static_cast<double>(sets[b]->NumberOfCells) * sizeof(std::int64_t) },
        [&]() { return lattice->Place(*sets[b], blocks[b].Array != nullptr, progress); });
    if (!isPlaced)
    {
      lattice.reset();
    }
  }
  return lattice;
}

// Auto would take the luminance of a colour in one block and the magnitude of a vector in another,
// which have no common unit. Blocks of one component, where nothing is to choose, agree with any.
int commonComponent(const std::vector<DensityBlock>& blocks, int component)
{
  DensityRules rules;
  rules.Component = component;
  const DensityBlock* first = nullptr;
  int taken = 0;
  for (const DensityBlock& block : blocks)
  {
    const int own = rulesOf(block, rules).Component;
    if (first && block.Array->GetNumberOfComponents() > 1 && own != taken)
    {
      fail("Component -1 (Auto) takes the ", own == Luminance ? "luminance" : "magnitude",
        " of the ", nameOf(block), ", but not of the ", nameOf(*first), "; set Component");
    }
    if (!first && block.Array->GetNumberOfComponents() > 1)
    {
      first = &block;
      taken = own;
    }
  }
  return first ? taken : rulesOf(blocks.front(), rules).Component;
}

// Two passes if the density is inverted: white, the largest value of all blocks, is known only
// after all were read.
BlockValues readBlocks(const std::vector<DensityBlock>& blocks, const CellSets& sets, bool onPoints,
  const MassCells& mass, const DensityRules& rules, Progress& progress)
{
  std::vector<SetReading> readings;
  readings.reserve(blocks.size());
  bool needWhite = false;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    vtkDataArray* array = blocks[b].Array;
    const DensityRules taken = rulesOf(blocks[b], rules);
    needWhite = needWhite || taken.NeedsWhite(array->GetNumberOfComponents());
    withMemory({ "the flags of the cells of the " + blocks[b].Name,
                 static_cast<double>(sets[b]->NumberOfCells) },
      [&]() {
        readings.emplace_back(makeDensityReader(array, taken), nameOf(blocks[b]),
          array->GetDataType() == VTK_UNSIGNED_CHAR, sets[b], onPoints, mass, progress);
      });
  }
  if (needWhite)
  {
    double white = -std::numeric_limits<double>::infinity();
    for (SetReading& reading : readings)
    {
      white = std::max(white, reading.FindLargest(progress));
    }
    for (SetReading& reading : readings)
    {
      reading.SetWhite(std::isfinite(white) ? white : 0.0);
    }
  }
  BlockValues values;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    SetReading& reading = readings[b];
    const std::int64_t count = reading.NumberOfValues();
    reading.Read(withMemory({ "the values of the " + reading.Found.Array,
                              static_cast<double>(count) * sizeof(double) },
                   [&]() { return LargeBuffer<double>(count); }),
      progress);
    values.Cells.push_back(std::move(reading.Cells));
    values.Findings.push_back(std::move(reading.Found));
    values.Data.push_back(blocks[b].Data);
  }
  return values;
}

} // namespace RectifiedTransport::Bridge
