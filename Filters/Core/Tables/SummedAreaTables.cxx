// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/SummedAreaTables.h"

#include "Core/Parallel/Progress.h"
#include "Core/Tables/DensityInspection.h"
#include "Core/Tables/TableBuild.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// A coarse level exists if the domain is at least this many of its cells wide on every axis.
constexpr std::int64_t narrowestBox = 16;
// Tables past this size are prefetched.
constexpr std::int64_t cacheBytes = std::int64_t{ 1 } << 24;

// The least stride, in cache lines, that is at least `lines` and maps the rows that a particle's
// neighbourhood reads to different sets of the caches; those of a grid of 2^k cells would be in one
// set. `rowStride` is that of the axis before, 0 for the first.
std::int64_t spreadStride(std::int64_t lines, std::int64_t rowStride)
{
  constexpr std::int64_t sets = 64;
  constexpr int reach = 10;
  constexpr std::int64_t apart = 3;
  const auto distance = [](std::int64_t offset) {
    const std::int64_t set = ((offset % sets) + sets) % sets;
    return std::min(set, sets - set);
  };
  for (std::int64_t stride = lines; stride < lines + sets; ++stride)
  {
    bool spread = true;
    for (int step = 1; step <= reach && spread; ++step)
    {
      spread = distance(step * stride) >= apart;
    }
    const int across = rowStride > 0 ? 3 : 0;
    for (int step = 1; step <= across && spread; ++step)
    {
      for (int row = -across; row <= across && spread; ++row)
      {
        spread = distance(step * stride + row * rowStride) >= 2;
      }
    }
    if (spread)
    {
      return stride;
    }
  }
  return lines;
}

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

// A density times a power of two.
class ScaledDensity final : public DensityValues
{
public:
  ScaledDensity(const DensityValues& density, double scale)
    : Density(density)
    , Scale(scale)
  {
  }
  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    this->Density.Read(first, count, values);
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] *= this->Scale;
    }
  }

private:
  const DensityValues& Density;
  double Scale;
};

} // namespace

template <int Dimension>
SummedAreaTables<Dimension>::SummedAreaTables(
  const DensitySource<Dimension>& density, Progress& progress, TableMemory memory)
  : Memory(std::move(memory))
{
  this->Allocate(density.Size);
  this->Build(density.Values, progress);
  const DensitySummary found = this->Found;
  requireDensity(found);
  // Moments of very large values overflow, those of very small ones lose bits: scaling by a power
  // of two prevents both and does not round.
  constexpr double extreme = 1e200;
  this->Tables.Largest = found.Maximum;
  if (found.Maximum > extreme || found.Maximum < 1.0 / extreme)
  {
    const int exponent = std::max(-1000, std::min(1000, -std::ilogb(found.Maximum)));
    const ScaledDensity scaled(density.Values, std::ldexp(1.0, exponent));
    this->Build(scaled, progress);
    this->Found = found;
    this->Tables.Largest = std::ldexp(found.Maximum, exponent);
  }

  TableView<Dimension>& tables = this->Tables;
  std::int64_t node = 0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    node += tables.Cells[axis] *
      (axis == 0 ? TableView<Dimension>::Record : tables.Levels[0].Stride[axis]);
  }
  const double* last = this->Memory.Nodes.data() + node;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    tables.Centroid[axis] = last[1 + axis] / last[0];
  }
  constexpr double roundingShare = 2e-15;
  tables.VoidMass = roundingShare * last[0];
  bool full = true;
  for (std::int64_t word = 0; word < this->Memory.Occupied.size() && full; ++word)
  {
    full = this->Memory.Occupied.data()[word] == ~std::uint64_t{ 0 };
  }
  tables.Occupied = full ? nullptr : this->Memory.Occupied.data();
}

template <int Dimension>
void SummedAreaTables<Dimension>::Allocate(const GridSize<Dimension>& size)
{
  TableView<Dimension>& tables = this->Tables;
  const std::int64_t narrowest = *std::min_element(size.begin(), size.end());
  tables.LevelCount = 1;
  while ((narrowestBox << (tables.LevelCount * levelShift)) <= narrowest)
  {
    ++tables.LevelCount;
  }
  const std::int64_t widest = std::int64_t{ 1 } << ((tables.LevelCount - 1) * levelShift);
  double estimate = TableView<Dimension>::Record;
  std::int64_t rows = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    tables.Cells[axis] = size[axis];
    tables.Size[axis] = static_cast<double>(size[axis]);
    tables.EvenLevels[axis] = size[axis] % widest == 0;
    estimate *= tables.Size[axis] + 1.0;
    rows *= axis > 0 ? size[axis] : 1;
  }
  if (estimate > 1e17)
  {
    throw std::bad_alloc();
  }
  constexpr std::int64_t line = 8;
  std::int64_t total = 0;
  std::int64_t offset[TableView<Dimension>::MaximumLevels];
  for (int level = 0; level < tables.LevelCount; ++level)
  {
    offset[level] = total;
    auto& stride = tables.Levels[level].Stride;
    const auto nodes = [&](int axis) { return ((size[axis] - 1) >> (level * levelShift)) + 2; };
    stride[0] = TableView<Dimension>::Record;
    for (int axis = 1; axis < Dimension; ++axis)
    {
      const std::int64_t lines = (stride[axis - 1] * nodes(axis - 1) + line - 1) / line;
      stride[axis] = spreadStride(lines, axis > 1 ? stride[axis - 1] / line : 0) * line;
    }
    total += (stride[Dimension - 1] * nodes(Dimension - 1) + line - 1) / line * line;
  }
  tables.BeyondCaches = total * static_cast<std::int64_t>(sizeof(double)) > cacheBytes;
  resize(this->Memory.Nodes, total);
  for (int level = 0; level < tables.LevelCount; ++level)
  {
    tables.Levels[level].Nodes = this->Memory.Nodes.data() + offset[level];
  }
  tables.WordsPerRow = (size[0] + 63) / 64;
  resize(this->Memory.Occupied, tables.WordsPerRow * rows);
}

template <int Dimension>
void SummedAreaTables<Dimension>::Build(const DensityValues& density, Progress& progress)
{
  this->Found = {};
  progress.BeginStage(1.0, this->Tables.Cells[Dimension - 1]);
  buildTables(TableBuild<Dimension>{ density, progress, this->Tables, this->Memory.Nodes.data(),
    this->Memory.Occupied.data(), this->Found });
}

template class SummedAreaTables<1>;
template class SummedAreaTables<2>;
template class SummedAreaTables<3>;

} // namespace RectifiedTransport
