// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/BlockValues.h"

#include "Bridge/Density/DensityFailure.h"
#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/DensityInspection.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
constexpr vtkIdType cellsBetweenPolls = vtkIdType{ 1 } << 16;
constexpr unsigned char unused = 1; // of values that are not read

std::string nameOf(const DensityBlock& block)
{
  return describeArray(block.Array) + " of the " + block.Name;
}

DensityRules rulesOf(const DensityBlock& block, const DensityRules& rules)
{
  DensityRules taken = rules;
  taken.Component = takenComponent(nameOf(block), rules.Component, block.Array->GetDataType(),
    block.Array->GetNumberOfComponents());
  return taken;
}

} // namespace

template <class Change>
BlockValues BlockValues::Changed(const Change& change) const
{
  BlockValues changed;
  changed.Set = this->Set;
  changed.OnPoints = this->OnPoints;
  changed.Cells = this->Cells;
  changed.Open = this->Open;
  changed.FirstOpen = this->FirstOpen;
  changed.NameOfBlock = this->NameOfBlock;
  const std::int64_t count = this->Density.size();
  withMemory("the values of the " + this->ArrayName,
    static_cast<double>(count) * sizeof(double) + static_cast<double>(this->Roles.size()), [&]() {
      changed.Density = LargeBuffer<double>(count);
      changed.Roles = this->Roles;
    });
  std::transform(
    this->Density.data(), this->Density.data() + count, changed.Density.data(), change);
  return changed;
}

BlockValues BlockValues::Only(double value) const
{
  return this->Changed([value](double density) { return density == value ? density : 0.0; });
}

BlockValues BlockValues::Ground() const
{
  // Closed lines are told apart by their values.
  const bool areLines = this->AreClosedLines();
  BlockValues ground = this->Changed([=](double density) { return areLines ? density : 1.0; });
  ground.IsGround = true;
  return ground;
}

// A block between the steps of reading it.
class BlockReading
{
public:
  BlockReading(const DensityBlock& block, bool onPoints, const MassCells& cells,
    const DensityRules& rules, Progress& progress)
    : Array(block.Array)
    , Rules(rulesOf(block, rules))
    , Reader(makeDensityReader(block.Array, this->Rules))
  {
    this->Read.Set = block.Data;
    this->Read.NameOfBlock = block.Name;
    this->Read.ArrayName = nameOf(block);
    this->Read.OnPoints = onPoints;
    this->Read.Cells = cells;
    this->FindCounted(block, progress);
    this->Reader->SetBlanks(this->Flags.data(), unused);
  }

  bool NeedsWhite() const { return needsWhite(this->Rules, this->Array->GetNumberOfComponents()); }
  // For white.
  double FindLargest()
  {
    LargestValue& white = this->Read.Known.White;
    if (hasDisplayedWhite(this->Rules, this->Array->GetDataType()))
    {
      white.Value = std::numeric_limits<unsigned char>::max();
    }
    else
    {
      white = this->Reader->Largest(0, static_cast<std::int64_t>(this->Flags.size()));
    }
    return white.Value;
  }

  void SetWhite(double white) { this->Reader->SetWhite(white); }

  BlockValues Finish(Progress& progress)
  {
    const auto count = static_cast<std::int64_t>(this->Flags.size());
    withMemory("the values of the " + this->Read.Name(),
      static_cast<double>(count) * sizeof(double),
      [&]() { this->Read.Density = LargeBuffer<double>(count); });
    double* values = this->Read.Density.data();
    progress.For(count, grain, [&](std::int64_t first, std::int64_t last) {
      this->Reader->Read(first, last - first, values + first);
    });
    const DensitySummary found = summarize(values, count, 0);
    if (found.NotFinite > 0 || found.Negative > 0)
    {
      throwInvalidDensity(this->Read.Name(), found, this->Rules.Missing);
    }
    this->Read.Known.Found = found;
    for (std::int64_t i = 0; i < count; ++i)
    {
      if (this->Flags[static_cast<std::size_t>(i)] == 0)
      {
        this->Read.LeastCounted = std::min(this->Read.LeastCounted, values[i]);
      }
    }
    if (this->Rules.ClampNegative && !this->Rules.Invert)
    {
      this->Read.Known.Clamped = findLowest(this->Array, *this->Reader, count, progress);
    }
    return std::move(this->Read);
  }

private:
  // Which values are missing; none if none can be.
  std::vector<unsigned char> FindMissing(Progress& progress) const
  {
    std::vector<unsigned char> missing;
    if (this->Rules.Missing.Are())
    {
      missing.resize(static_cast<std::size_t>(this->Array->GetNumberOfTuples()));
      progress.For(static_cast<std::int64_t>(missing.size()), grain,
        [&](std::int64_t first, std::int64_t last) {
          this->Reader->FindEmpty(first, last - first, missing.data() + first);
        });
    }
    return missing;
  }

  void FindCounted(const DensityBlock& block, Progress& progress)
  {
    vtkDataSet* data = block.Data;
    const MassCells& mass = this->Read.Cells;
    const bool onPoints = this->Read.OnPoints;
    const BlankedCells blanked(data, block.Name.c_str());
    const vtkIdType cells = data->GetNumberOfCells();
    this->Read.Roles.assign(static_cast<std::size_t>(cells), BlockValues::NotCounted);
    this->Flags.assign(
      static_cast<std::size_t>(onPoints ? data->GetNumberOfPoints() : cells), unused);
    const std::vector<unsigned char> missing = this->FindMissing(progress);
    const auto isMissing = [&missing](vtkIdType value) {
      return !missing.empty() && missing[static_cast<std::size_t>(value)] != 0;
    };
    vtkNew<vtkIdList> points;
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
      if (cell % cellsBetweenPolls == 0)
      {
        progress.Check();
      }
      if (!mass.HasDimension(data, cell) || blanked.Has(cell) || (!onPoints && isMissing(cell)))
      {
        continue;
      }
      if (mass.AreClosedLines && !mass.Find(data, cell, points))
      {
        this->Read.FirstOpen = this->Read.Open++ == 0 ? cell : this->Read.FirstOpen;
        continue;
      }
      if (blanked.MayHavePoints() || onPoints)
      {
        data->GetCellPoints(cell, points);
        const vtkIdType* first = points->GetPointer(0);
        const vtkIdType* last = first + points->GetNumberOfIds();
        if (blanked.HasPointOf(points) || (onPoints && std::any_of(first, last, isMissing)))
        {
          continue;
        }
      }
      this->Read.RoleOf(cell) = mass.AreClosedLines ? BlockValues::Region : BlockValues::Divided;
      if (!onPoints)
      {
        this->Flags[static_cast<std::size_t>(cell)] = 0;
        continue;
      }
      for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
      {
        this->Flags[static_cast<std::size_t>(points->GetId(i))] = 0;
      }
    }
  }

  vtkDataArray* Array;
  const DensityRules Rules;
  std::unique_ptr<DensityReader> Reader;
  std::vector<unsigned char> Flags; // of the values
  BlockValues Read;
};

int takenComponent(const std::vector<DensityBlock>& blocks, int component)
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

std::vector<BlockValues> readBlocks(const std::vector<DensityBlock>& blocks, bool onPoints,
  const MassCells& cells, const DensityRules& rules, Progress& progress)
{
  std::vector<BlockReading> readings;
  readings.reserve(blocks.size());
  for (const DensityBlock& block : blocks)
  {
    withMemory("the flags of the cells of the " + block.Name,
      static_cast<double>(block.Data->GetNumberOfCells()),
      [&]() { readings.emplace_back(block, onPoints, cells, rules, progress); });
  }
  if (std::any_of(readings.begin(), readings.end(),
        [](const BlockReading& reading) { return reading.NeedsWhite(); }))
  {
    double white = -std::numeric_limits<double>::infinity();
    for (BlockReading& reading : readings)
    {
      white = std::max(white, reading.FindLargest());
    }
    for (BlockReading& reading : readings)
    {
      reading.SetWhite(std::isfinite(white) ? white : 0.0);
    }
  }
  std::vector<BlockValues> values;
  values.reserve(readings.size());
  for (BlockReading& reading : readings)
  {
    values.push_back(reading.Finish(progress));
  }
  return values;
}

} // namespace RectifiedTransport::Bridge
