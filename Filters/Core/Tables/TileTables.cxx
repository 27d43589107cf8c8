// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/TileTables.h"

#include "Core/Parallel/Progress.h"
#include "Core/Tables/NodeLayout.h"
#include "Core/Tables/ScaledDensity.h"
#include "Core/Tables/TableBuild.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// Rows of a part, or pieces of rows.
template <int Dimension>
class PartOfDensity final : public DensityValues
{
public:
  PartOfDensity(const DensityValues& whole, const GridSize<Dimension>& size,
    const GridSize<Dimension>& low, const GridSize<Dimension>& cells)
    : Whole(whole)
    , Size(size)
    , Low(low)
    , Cells(cells)
  {
  }

  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    std::int64_t rest = first / this->Cells[0];
    std::int64_t start = this->Low[0] + first % this->Cells[0];
    std::int64_t stride = this->Size[0];
    for (int axis = 1; axis < Dimension; ++axis)
    {
      start += (this->Low[axis] + rest % this->Cells[axis]) * stride;
      rest /= this->Cells[axis];
      stride *= this->Size[axis];
    }
    this->Whole.Read(start, count, values);
  }

private:
  const DensityValues& Whole;
  const GridSize<Dimension>& Size;
  const GridSize<Dimension>& Low;
  const GridSize<Dimension>& Cells;
};

std::int64_t wordsPerRow(std::int64_t cells)
{
  return (cells + 63) / 64;
}

template <int Dimension>
GridSize<Dimension> nodesOf(const GridSize<Dimension>& cells)
{
  GridSize<Dimension> nodes;
  std::transform(
    cells.begin(), cells.end(), nodes.begin(), [](std::int64_t along) { return along + 1; });
  return nodes;
}

} // namespace

template <int Dimension>
TileTables<Dimension>::TileTables(const TableView<Dimension>& whole, int scaling)
  : Scaling(scaling)
  , Tables(whole)
{
  this->Tables.IsUneven = false;
  this->Tables.IsPart = true;
  this->Tables.LevelCount = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    this->Tables.EvenLevels[axis] = true; // of cells of width 1
  }
}

template <int Dimension>
void TileTables<Dimension>::Reserve(const GridSize<Dimension>& cells)
{
  std::int64_t stride[Dimension];
  const std::int64_t doubles = layOutNodes<Dimension>(nodesOf<Dimension>(cells), stride);
  std::int64_t words = wordsPerRow(cells[0]);
  for (int axis = 1; axis < Dimension; ++axis)
  {
    words *= cells[axis];
  }
  if (this->Nodes.size() < doubles || this->Occupied.size() < words)
  {
    this->Nodes = {};
    this->Nodes = LargeBuffer<double>(doubles);
    this->Occupied = LargeBuffer<std::uint64_t>(words);
  }
}

template <int Dimension>
void TileTables<Dimension>::Build(const DensityValues& density, const GridSize<Dimension>& low,
  const GridSize<Dimension>& high, Progress& progress)
{
  // As if the part were the domain; what is summed but for the nodes is not used.
  TableView<Dimension> part = this->Tables;
  GridSize<Dimension> cells;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    cells[axis] = high[axis] - low[axis];
    part.Cells[axis] = cells[axis];
  }
  this->Reserve(cells);
  part.WordsPerRow = wordsPerRow(cells[0]);
  const std::int64_t doubles =
    layOutNodes<Dimension>(nodesOf<Dimension>(cells), part.Levels[0].Stride);
  part.Levels[0].Nodes = this->Nodes.data();
  GridSize<Dimension> size;
  std::copy_n(this->Tables.Cells, Dimension, size.begin());
  const PartOfDensity<Dimension> values(density, size, low, cells);
  const ScaledDensity scaled(values, this->Scaling);
  const DensityValues* read = &values;
  if (this->Scaling != 0)
  {
    read = &scaled;
  }
  DensitySummary found;
  progress.Expect(cells[Dimension - 1]);
  buildTables(TableBuild<Dimension>{
    *read, progress, part, this->Nodes.data(), this->Occupied.data(), found, low });

  constexpr std::int64_t cacheBytes = std::int64_t{ 1 } << 24;
  this->Tables.BeyondCaches = doubles * static_cast<std::int64_t>(sizeof(double)) > cacheBytes;
  this->Tables.Levels[0] = part.Levels[0];
  for (int axis = 0; axis < Dimension; ++axis)
  {
    this->Tables.Low[axis] = static_cast<double>(low[axis]);
    this->Tables.High[axis] = static_cast<double>(high[axis]);
    this->Tables.Levels[0].Nodes -= low[axis] * this->Tables.Levels[0].Stride[axis];
  }
}

template <int Dimension>
double TileTables<Dimension>::MemoryFor(const GridSize<Dimension>& cells)
{
  std::int64_t stride[Dimension];
  constexpr double bits = 1.0 / 8.0;
  return static_cast<double>(layOutNodes<Dimension>(nodesOf<Dimension>(cells), stride)) *
    sizeof(double) +
    bits * numberOfCells<Dimension>(cells);
}

template class TileTables<2>;
template class TileTables<3>;

} // namespace RectifiedTransport
