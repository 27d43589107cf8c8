// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cells/BlockValues.h"

#include "Bridge/Density/DensityFailure.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
constexpr unsigned char unused = 1; // flags values that are not read

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

// A block between the steps of reading it.
class BlockReading
{
public:
  BlockReading(const DensityBlock& block, const std::shared_ptr<const CellSet>& set, bool onPoints,
    const MassCells& mass, const DensityRules& rules, Progress& progress)
    : Array(block.Array)
    , Rules(rulesOf(block, rules))
    , Reader(makeDensityReader(block.Array, this->Rules))
    , Cells(set, mass, onPoints, this->FindMissing(progress), this->Flags, progress)
    , Found{ block.Data, block.Name, nameOf(block), {} }
  {
    this->Reader->SetBlanks(this->Flags.data(), unused);
  }

  bool NeedsWhite() const { return needsWhite(this->Rules, this->Array->GetNumberOfComponents()); }
  // For white.
  double FindLargest()
  {
    LargestValue& white = this->Found.Known.White;
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

  void Finish(Progress& progress, BlockValues& all)
  {
    const auto count = static_cast<std::int64_t>(this->Flags.size());
    LargeBuffer<double> density;
    withMemory(
      { "the values of the " + this->Found.Array, static_cast<double>(count) * sizeof(double) },
      [&]() { density = LargeBuffer<double>(count); });
    double* values = density.data();
    progress.For(count, grain, [&](std::int64_t first, std::int64_t last) {
      this->Reader->Read(first, last - first, values + first);
    });
    const DensitySummary found = summarize(values, count, 0);
    if (found.NotFinite > 0 || found.Negative > 0)
    {
      throwInvalidDensity(this->Found.Array, found, this->Rules.Missing);
    }
    this->Found.Known.Found = found;
    for (std::int64_t i = 0; i < count; ++i)
    {
      if (this->Flags[static_cast<std::size_t>(i)] == 0)
      {
        this->Found.Least = std::min(this->Found.Least, values[i]);
      }
    }
    if (this->Rules.ClampNegative && !this->Rules.Invert)
    {
      this->Found.Known.Clamped = findLowest(this->Array, *this->Reader, count, progress);
    }
    this->Cells.SetValues(std::move(density));
    all.Cells.push_back(std::move(this->Cells));
    all.Sources.push_back(std::move(this->Found));
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

  vtkDataArray* Array;
  const DensityRules Rules;
  std::unique_ptr<DensityReader> Reader;
  std::vector<unsigned char> Flags; // one for each value
  CellValues Cells;
  BlockValues::Source Found;
};

} // namespace

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

BlockValues readBlocks(const std::vector<DensityBlock>& blocks, const CellSets& sets, bool onPoints,
  const MassCells& mass, const DensityRules& rules, Progress& progress)
{
  std::vector<BlockReading> readings;
  readings.reserve(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    withMemory({ "the flags of the cells of the " + blocks[b].Name,
                 static_cast<double>(sets[b]->NumberOfCells) },
      [&]() { readings.emplace_back(blocks[b], sets[b], onPoints, mass, rules, progress); });
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
  BlockValues values;
  for (BlockReading& reading : readings)
  {
    reading.Finish(progress, values);
  }
  return values;
}

} // namespace RectifiedTransport::Bridge
