// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/BlockValues.h"

#include "Bridge/Density/DensityFailure.h"
#include "Bridge/Points/GhostFlags.h"
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

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
constexpr vtkIdType cellsBetweenPolls = vtkIdType{ 1 } << 16;
constexpr unsigned char unused = 1; // of values that are not read

} // namespace

vtkDataSet* BlockValues::Data() const
{
  return this->Set;
}

void BlockValues::SetData(vtkDataSet* data)
{
  this->Set = data;
}

BlockValues BlockValues::Only(double value) const
{
  BlockValues only;
  only.Set = this->Set;
  only.OnPoints = this->OnPoints;
  only.Cells = this->Cells;
  only.Open = this->Open;
  const std::int64_t count = this->Density.size();
  withMemory("the values of the " + this->ArrayName,
    static_cast<double>(count) * sizeof(double) + static_cast<double>(this->Counted.size()), [&]() {
      only.Density = LargeBuffer<double>(count);
      only.Counted = this->Counted;
    });
  std::transform(this->Density.data(), this->Density.data() + count, only.Density.data(),
    [value](double density) { return density == value ? density : 0.0; });
  return only;
}

// A block between the steps of reading it.
class BlockReading
{
public:
  BlockReading(const DensityBlock& block, bool onPoints, const MassCells& cells,
    const DensityRules& rules, Progress& progress)
    : Name(describeArray(block.Array) + " of the " + block.Name)
    , Array(block.Array)
    , Clamps(rules.ClampNegative && !rules.Invert)
    , Reader(makeDensityReader(block.Array, rules))
  {
    requireComponent(Name, rules.Component, block.Array->GetNumberOfComponents());
    this->Read.Set = block.Data;
    this->Read.ArrayName = this->Name;
    this->Read.OnPoints = onPoints;
    this->Read.Cells = cells;
    this->FindCounted(block, progress);
    this->Reader->SetBlanks(this->Flags.data(), unused);
  }

  // For white.
  double FindLargest()
  {
    if (this->Array->GetDataType() == VTK_UNSIGNED_CHAR)
    {
      this->Read.Known.White.Value = std::numeric_limits<unsigned char>::max();
    }
    else
    {
      this->Read.Known.White =
        this->Reader->Largest(0, static_cast<std::int64_t>(this->Flags.size()));
    }
    return this->Read.Known.White.Value;
  }

  void SetWhite(double white) { this->Reader->SetWhite(white); }

  void ReadValues(Progress& progress)
  {
    const auto count = static_cast<std::int64_t>(this->Flags.size());
    withMemory("the values of the " + this->Name, static_cast<double>(count) * sizeof(double),
      [&]() { this->Read.Density = LargeBuffer<double>(count); });
    double* values = this->Read.Density.data();
    progress.For(count, grain, [&](std::int64_t first, std::int64_t last) {
      this->Reader->Read(first, last - first, values + first);
    });
    DensitySummary summary;
    for (std::int64_t i = 0; i < count; ++i)
    {
      summary.Total += values[i];
      if (!std::isfinite(values[i]))
      {
        summary.FirstNotFinite = summary.NotFinite++ == 0 ? i : summary.FirstNotFinite;
      }
      else if (values[i] < 0.0)
      {
        summary.FirstNegative = summary.Negative++ == 0 ? i : summary.FirstNegative;
      }
    }
    if (summary.NotFinite > 0 || summary.Negative > 0)
    {
      throwInvalidDensity(this->Name, summary);
    }
    if (count > 0)
    {
      const auto [least, largest] = std::minmax_element(values, values + count);
      inspectLargest(values, count, 0, *least, *largest, summary);
    }
    this->Read.Known.Found = summary;
    if (this->Clamps)
    {
      this->Read.Known.Clamped = findLowest(this->Array, *this->Reader, count, progress);
    }
  }

  BlockValues Take() { return std::move(this->Read); }

private:
  void FindCounted(const DensityBlock& block, Progress& progress)
  {
    vtkDataSet* data = block.Data;
    const BlankedCells blanked(data, block.Name.c_str());
    const vtkIdType cells = data->GetNumberOfCells();
    this->Read.Counted.assign(static_cast<std::size_t>(cells), 0);
    this->Flags.assign(
      static_cast<std::size_t>(this->Read.OnPoints ? data->GetNumberOfPoints() : cells), unused);
    vtkNew<vtkIdList> points;
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
      if (cell % cellsBetweenPolls == 0)
      {
        progress.Check();
      }
      const MassCells& mass = this->Read.Cells;
      if (!mass.HasDimension(data, cell) || blanked.Has(cell))
      {
        continue;
      }
      if (mass.AreClosedLines && !mass.Find(data, cell, points))
      {
        ++this->Read.Open;
        continue;
      }
      bool counts = true;
      if (blanked.MayHavePoints() || this->Read.OnPoints)
      {
        data->GetCellPoints(cell, points);
        counts = !blanked.HasPointOf(points);
      }
      this->Read.Counted[static_cast<std::size_t>(cell)] = counts ? 1 : 0;
      if (counts && mass.AreClosedLines)
      {
        this->Read.MarkAsRegion(cell);
      }
      if (!counts)
      {
        continue;
      }
      if (!this->Read.OnPoints)
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

  const std::string Name;
  vtkDataArray* Array;
  const bool Clamps;
  std::unique_ptr<DensityReader> Reader;
  std::vector<unsigned char> Flags; // of the values
  BlockValues Read;
};

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
  if (needsWhite(rules, blocks.front().Array->GetNumberOfComponents()))
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
    reading.ReadValues(progress);
    values.push_back(reading.Take());
  }
  return values;
}

} // namespace RectifiedTransport
