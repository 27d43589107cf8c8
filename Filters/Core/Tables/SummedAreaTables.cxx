// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/SummedAreaTables.h"

#include "Core/Parallel/Progress.h"
#include "Core/Tables/DensityInspection.h"
#include "Core/Tables/NodeLayout.h"
#include "Core/Tables/ScaledDensity.h"
#include "Core/Tables/TableBuild.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace RectifiedTransport
{

namespace
{

// A coarse level exists if the domain is at least this many of its cells wide on every axis.
constexpr std::int64_t narrowestBox = 16;
// Tables past this size are prefetched.
constexpr std::int64_t cacheBytes = std::int64_t{ 1 } << 24;

// Keeps memory of the right size; other memory is freed before new is allocated.
template <class T>
void resize(LargeBuffer<T>& buffer, std::int64_t size)
{
  if (buffer.size() != size)
  {
    buffer = {};
    buffer = LargeBuffer<T>(size);
  }
}

} // namespace

template <int Dimension>
SummedAreaTables<Dimension>::SummedAreaTables(
  const DensitySource<Dimension>& density, Progress& progress, TableMemory memory)
  : Memory(std::move(memory))
{
  this->Allocate(density.Size);
  TableView<Dimension>& tables = this->Tables;
  double* const nodes = this->Memory.Nodes.data();
  std::uint64_t* const occupied = this->Memory.Occupied.data();
  const std::int64_t layers = tables.Cells[Dimension - 1];
  const std::shared_ptr<const DensityValues> values = density.Whole();
  progress.Expect(layers);
  buildTables(TableBuild<Dimension>{ *values, progress, tables, nodes, occupied, this->Found });
  requireDensity(this->Found);
  // Extreme values are scaled (ScaledDensity.h). The summary stays that of the density itself.
  const int exponent = scalingOf(this->Found.Maximum);
  tables.Largest = std::ldexp(this->Found.Maximum, exponent);
  if (exponent != 0)
  {
    const ScaledDensity scaled(*values, exponent);
    DensitySummary ofScaled;
    progress.Expect(layers);
    buildTables(TableBuild<Dimension>{ scaled, progress, tables, nodes, occupied, ofScaled });
  }

  // The last node has the sums of the whole density.
  std::int64_t node = 0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    node += tables.Cells[axis] * tables.Levels[0].Stride[axis];
  }
  setTotals(tables, nodes + node, occupied, this->Memory.Occupied.size());
}

template <int Dimension>
void SummedAreaTables<Dimension>::Allocate(const GridSize<Dimension>& size)
{
  TableView<Dimension>& tables = this->Tables;
  // Level l has cells 4^l wide. A narrower domain has fewer levels: boxes take a level only if they
  // are many of its cells wide.
  const std::int64_t narrowest = *std::min_element(size.begin(), size.end());
  tables.LevelCount = 1;
  while ((narrowestBox << (tables.LevelCount * levelShift)) <= narrowest)
  {
    ++tables.LevelCount;
  }
  // The width of a cell on the coarsest level; sizes that it divides have no narrower last cell.
  const std::int64_t widest = std::int64_t{ 1 } << ((tables.LevelCount - 1) * levelShift);
  // Sizes in bytes must fit into 64 bits.
  if (TableView<Dimension>::Record * numberOfCorners<Dimension>(size) > 1e17)
  {
    throw std::bad_alloc();
  }
  const std::int64_t words = setGrid<Dimension>(tables, size);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    tables.EvenLevels[axis] = size[axis] % widest == 0;
  }
  std::int64_t total = 0;
  std::int64_t offset[TableView<Dimension>::MaximumLevels];
  for (int level = 0; level < tables.LevelCount; ++level)
  {
    offset[level] = total;
    GridSize<Dimension> nodes;
    // Nodes at every 4^l-th cell, and one at the end.
    for (int axis = 0; axis < Dimension; ++axis)
    {
      nodes[axis] = ((size[axis] - 1) >> (level * levelShift)) + 2;
    }
    total += layOutNodes<Dimension>(nodes, tables.Levels[level].Stride);
  }
  tables.BeyondCaches = total * static_cast<std::int64_t>(sizeof(double)) > cacheBytes;
  resize(this->Memory.Nodes, total);
  for (int level = 0; level < tables.LevelCount; ++level)
  {
    tables.Levels[level].Nodes = this->Memory.Nodes.data() + offset[level];
  }
  resize(this->Memory.Occupied, words);
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(SummedAreaTables);

} // namespace RectifiedTransport
