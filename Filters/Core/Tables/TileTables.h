// SPDX-License-Identifier: BSD-3-Clause
// Summed-area tables (paper, Section 3.3) of a part of a density.
#ifndef RectifiedTransport_TileTables_h
#define RectifiedTransport_TileTables_h

#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/NodeLayout.h"
#include "Core/Tables/ScaledDensity.h"
#include "Core/Tables/TableBuild.h"

#include <algorithm>
#include <cstdint>
#include <functional>

namespace RectifiedTransport
{

// Reads the cells of a part under their numbers in it: whole rows, or pieces of rows.
template <int Dimension>
class DensityPart final : public DensityValues
{
public:
  DensityPart(const DensityValues& density, const GridSize<Dimension>& size,
    const LatticePart<Dimension>& part)
    : Density(density)
    , Whole(LatticePart<Dimension>::WholeOf(size))
    , Part(part)
  {
  }
  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    this->Density.Read(this->Whole.NumberOf(this->Part.CellOf(first)), count, values);
  }

private:
  const DensityValues& Density;
  const LatticePart<Dimension> Whole;
  const LatticePart<Dimension> Part;
};

// Only the finest level, in the coordinates of the whole domain; one part after another in the same
// memory. The same bits for every executor.
template <int Dimension>
class TileTables
{
public:
  // `whole` are tables of the whole density. The parts take the rest of the view from them, and
  // they must outlive this object. Their values are scaled by 2^scaling.
  TileTables(const TableView<Dimension>& whole, int scaling)
    : Scaling(scaling)
    , Tables(whole)
  {
    this->Tables.IsUneven = false;
    this->Tables.IsPart = true;
    this->Tables.LevelCount = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Tables.EvenLevels[axis] = true; // all cells have the width 1
    }
  }

  // Allocates the memory for tables of this number of cells at once; growing from small tables
  // would fragment it. Throws std::bad_alloc.
  void Reserve(const GridSize<Dimension>& cells)
  {
    std::int64_t stride[Dimension];
    const std::int64_t doubles = layOut(cells, stride);
    TableView<Dimension> part;
    const std::int64_t words = setGrid<Dimension>(part, cells);
    if (this->Nodes.size() < doubles || this->Occupied.size() < words)
    {
      this->Nodes = {};
      this->Nodes = LargeBuffer<double>(doubles);
      this->Occupied = LargeBuffer<std::uint64_t>(words);
    }
  }

  // Builds the tables of the grid cells from `low` up to `high` of the whole density. Throws
  // Cancelled and std::bad_alloc.
  void Build(const DensityValues& density, const GridSize<Dimension>& low,
    const GridSize<Dimension>& high, Progress& progress)
  {
    GridSize<Dimension> size;
    std::copy_n(this->Tables.Cells, Dimension, size.begin());
    GridSize<Dimension> cells;
    std::transform(high.begin(), high.end(), low.begin(), cells.begin(), std::minus<>());
    this->Reserve(cells);
    // Builds as if the part were the domain. Only the nodes are kept: the other sums of the part
    // have no use.
    TableView<Dimension> part = this->Tables;
    setGrid<Dimension>(part, cells);
    const std::int64_t doubles = layOut(cells, part.Levels[0].Stride);
    part.Levels[0].Nodes = this->Nodes.data();
    const DensityPart<Dimension> values(density, size, { low, cells });
    DensitySummary found;
    progress.Expect(cells[Dimension - 1]);
    buildTables(TableBuild<Dimension>{ ScaledDensity(values, this->Scaling), progress, part,
      this->Nodes.data(), this->Occupied.data(), found, low });

    // Tables past this size, 16 MiB, are prefetched.
    constexpr std::int64_t cacheBytes = std::int64_t{ 1 } << 24;
    this->Tables.BeyondCaches = doubles * static_cast<std::int64_t>(sizeof(double)) > cacheBytes;
    this->Tables.Levels[0] = part.Levels[0];
    // Pointers become those of node 0 of the domain, so that kernels index parts and whole tables
    // in the same way.
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Tables.Low[axis] = static_cast<double>(low[axis]);
      this->Tables.High[axis] = static_cast<double>(high[axis]);
      this->Tables.Levels[0].Nodes -= low[axis] * this->Tables.Levels[0].Stride[axis];
    }
  }

  const TableView<Dimension>& View() const { return this->Tables; }
  // The bytes of tables of this number of cells.
  static double MemoryFor(const GridSize<Dimension>& cells)
  {
    std::int64_t stride[Dimension];
    constexpr double bits = 1.0 / 8.0;
    return static_cast<double>(layOut(cells, stride)) * sizeof(double) +
      bits * numberOfCells<Dimension>(cells);
  }

private:
  static std::int64_t layOut(GridSize<Dimension> cells, std::int64_t (&stride)[Dimension])
  {
    for (std::int64_t& along : cells)
    {
      ++along; // nodes
    }
    return layOutNodes<Dimension>(cells, stride);
  }

  const int Scaling;
  TableView<Dimension> Tables;
  LargeBuffer<double> Nodes;
  LargeBuffer<std::uint64_t> Occupied; // one bit a cell of the part
};

} // namespace RectifiedTransport

#endif
