// SPDX-License-Identifier: BSD-3-Clause
#include "SummedAreaTables.h"

#include "FlowKernels.h"
#include "Pacer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace RectifiedTransport
{

namespace
{

// A coarse level is of use only while a box can be this many of its cells wide.
constexpr std::int64_t narrowestBox = 16;
// Sums are taken over strips of this many cells, whatever runs them.
constexpr std::int64_t stripCells = 256; // along axis 0, in 2D
constexpr std::int64_t stripRows = 32;   // along axis 1, in 3D
constexpr std::int64_t slabBytes = std::int64_t{ 1 } << 21;
// Tables past this size are written past the caches and fetched ahead.
constexpr std::int64_t cacheBytes = std::int64_t{ 1 } << 24;

// Counts what is wrong with cells, of which the first has the index `index`.
void findWrong(const double* values, std::int64_t count, std::int64_t index, DensitySummary& found)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    if (!std::isfinite(values[i]))
    {
      found.FirstNotFinite = found.NotFinite++ == 0 ? index + i : found.FirstNotFinite;
    }
    else if (values[i] < 0.0)
    {
      found.FirstNegative = found.Negative++ == 0 ? index + i : found.FirstNegative;
    }
  }
}

// One bit a cell that has mass.
void markOccupied(const double* values, std::int64_t count, std::uint64_t* words)
{
  for (std::int64_t first = 0; first < count; first += 64)
  {
    const int cells = static_cast<int>(std::min<std::int64_t>(64, count - first));
    std::uint64_t word = 0;
    for (int i = 0; i < cells; ++i)
    {
      word |= static_cast<std::uint64_t>(values[first + i] > 0.0) << i;
    }
    words[first / 64] = word;
  }
}

// Inspects part of a row, whose first cell has the index `index`, and marks its cells.
RowInspection inspectCells(const double* values, std::int64_t count, std::int64_t index,
  std::uint64_t* words, DensitySummary& found)
{
  const RowInspection row = flowKernels().Inspect(values, count);
  found.Maximum = std::max(found.Maximum, row.Largest);
  if (row.Wrong > 0)
  {
    findWrong(values, count, index, found);
  }
  if (row.Smallest > 0.0)
  {
    std::fill_n(words, (count + 63) / 64, ~std::uint64_t{ 0 });
  }
  else
  {
    markOccupied(values, count, words);
  }
  return row;
}

void merge(const DensitySummary& part, DensitySummary& whole)
{
  const auto first = [](std::int64_t a, std::int64_t b) {
    return a < 0 ? b : b < 0 ? a : std::min(a, b);
  };
  whole.NotFinite += part.NotFinite;
  whole.FirstNotFinite = first(whole.FirstNotFinite, part.FirstNotFinite);
  whole.Negative += part.Negative;
  whole.FirstNegative = first(whole.FirstNegative, part.FirstNegative);
  whole.Maximum = std::max(whole.Maximum, part.Maximum);
  whole.Total += part.Total;
}

void fenceStreams()
{
#ifdef __SSE2__
  _mm_sfence();
#endif
}

// The number of a node on a level, -1 if the level does not have it.
std::int64_t coarseNode(std::int64_t node, std::int64_t size, int level)
{
  const int shift = level * levelShift;
  const std::int64_t width = std::int64_t{ 1 } << shift;
  return node == size || (node & (width - 1)) == 0 ? (node + width - 1) >> shift : -1;
}

// Copies the nodes (first, first + count] of one row that level `level` has. `nodes` starts with
// node first + 1, `coarse` with the level's node 0.
template <int Record>
void copyToLevel(const double* nodes, std::int64_t first, std::int64_t count, std::int64_t size,
  int level, double* coarse)
{
  const int shift = level * levelShift;
  const std::int64_t width = std::int64_t{ 1 } << shift;
  std::int64_t place = (first >> shift) + 1;
  for (std::int64_t node = place << shift; node <= first + count; node += width, ++place)
  {
    std::copy_n(nodes + (node - first - 1) * Record, Record, coarse + place * Record);
  }
  if (first + count == size && (size & (width - 1)) != 0)
  {
    std::copy_n(nodes + (count - 1) * Record, Record, coarse + place * Record);
  }
}

// The least stride, in cache lines, that is at least `lines` and sends the rows that a particle's
// neighbourhood reads to different sets of the caches. A grid of 2^k cells would send them all to
// one. `rowStride` is that of the axis before, 0 for the first.
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

// What a build shares between its passes.
template <int Dimension>
struct Build
{
  const DensitySource<Dimension>& Density;
  double Scale;
  const Executor& Run;
  Pacer& Pace;
  TableView<Dimension>& Tables;
  double* Nodes;
  std::uint64_t* Occupied;
  DensitySummary& Found;

  double* Level(int level) const { return const_cast<double*>(this->Tables.Levels[level].Nodes); }
};

bool buildTables(const Build<1>& build)
{
  const std::int64_t size = build.Tables.Cells[0];
  constexpr std::int64_t segment = 1 << 16;
  std::vector<double> values(static_cast<std::size_t>(std::min(size, segment)));
  std::vector<double> nodes(values.size() * 2);
  double sum = 0.0;
  double moment = 0.0;
  for (int level = 0; level < build.Tables.LevelCount; ++level)
  {
    std::fill_n(build.Level(level), 2, 0.0);
  }
  for (std::int64_t first = 0; first < size; first += segment)
  {
    build.Pace.NextSlice(1);
    const std::int64_t count = std::min(segment, size - first);
    build.Density.ReadRow(0, first, count, values.data());
    DensitySummary part;
    part.Total =
      inspectCells(values.data(), count, first, build.Occupied + first / 64, part).Sum;
    merge(part, build.Found);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const double value = values[i] * build.Scale;
      sum += value;
      moment += value * (static_cast<double>(first + i) + 0.5);
      nodes[2 * i] = sum;
      nodes[2 * i + 1] = moment;
    }
    for (int level = 0; level < build.Tables.LevelCount; ++level)
    {
      copyToLevel<2>(nodes.data(), first, count, size, level, build.Level(level));
    }
    if (!build.Pace.EndSlice(1))
    {
      return false;
    }
  }
  return true;
}

bool buildTables(const Build<2>& build)
{
  const std::int64_t columns = build.Tables.Cells[0];
  const std::int64_t rows = build.Tables.Cells[1];
  const std::int64_t strips = (columns + stripCells - 1) / stripCells;
  const std::int64_t slab =
    std::min(rows, std::max<std::int64_t>(1, slabBytes / 8 / columns));
  LargeBuffer<double> values(slab * columns);
  LargeBuffer<double> prefixes(slab * strips * 2);
  LargeBuffer<double> running(columns * 4);
  std::vector<DensitySummary> found(static_cast<std::size_t>(slab));
  std::fill_n(running.data(), running.size(), 0.0);
  for (int level = 0; level < build.Tables.LevelCount; ++level)
  {
    std::fill_n(build.Level(level), build.Tables.Levels[level].Stride[1], 0.0);
  }
  const AddTableRow2D addRow = flowKernels().AddRow2D;

  for (std::int64_t begin = 0; begin < rows;)
  {
    const std::int64_t count =
      std::min({ slab, rows - begin, build.Pace.NextSlice(std::min<std::int64_t>(slab, 16)) });
    build.Run.For(count, 8, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t j = first; j < last; ++j)
      {
        const std::int64_t row = begin + j;
        double* cells = values.data() + j * columns;
        double sum = 0.0;
        double moment = 0.0;
        DensitySummary part;
        for (std::int64_t strip = 0; strip < strips; ++strip)
        {
          const std::int64_t start = strip * stripCells;
          const std::int64_t length = std::min(stripCells, columns - start);
          build.Density.ReadRow(row, start, length, cells + start);
          double* prefix = prefixes.data() + (j * strips + strip) * 2;
          prefix[0] = sum * build.Scale;
          prefix[1] = moment * build.Scale;
          const RowInspection sums = inspectCells(cells + start, length, row * columns + start,
            build.Occupied + row * build.Tables.WordsPerRow + start / 64, part);
          sum += sums.Sum;
          moment += sums.Moment + sums.Sum * static_cast<double>(start);
        }
        part.Total = sum;
        found[j] = part;
      }
    });
    for (std::int64_t j = 0; j < count; ++j)
    {
      merge(found[j], build.Found);
    }
    build.Run.For(strips, 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t strip = first; strip < last; ++strip)
      {
        TableRow2D row;
        row.First = strip * stripCells;
        row.Count = std::min(stripCells, columns - row.First);
        row.Scale = build.Scale;
        row.Running = running.data() + row.First * 4;
        row.Stream = build.Tables.BeyondCaches;
        for (std::int64_t j = 0; j < count; ++j)
        {
          const std::int64_t node = begin + j + 1;
          row.Values = values.data() + j * columns + row.First;
          std::copy_n(prefixes.data() + (j * strips + strip) * 2, 2, row.Prefix);
          row.Centre = static_cast<double>(begin + j) + 0.5;
          row.Nodes =
            build.Nodes + node * build.Tables.Levels[0].Stride[1] + (row.First + 1) * 4;
          addRow(row);
          for (int level = 0; level < build.Tables.LevelCount; ++level)
          {
            const std::int64_t coarse = coarseNode(node, rows, level);
            if (coarse >= 0)
            {
              double* target = build.Level(level) + coarse * build.Tables.Levels[level].Stride[1];
              if (strip == 0)
              {
                std::fill_n(target, 4, 0.0);
              }
              if (level > 0)
              {
                copyToLevel<4>(row.Running, row.First, row.Count, columns, level, target);
              }
            }
          }
        }
      }
      fenceStreams();
    });
    begin += count;
    if (!build.Pace.EndSlice(count))
    {
      return false;
    }
  }
  return true;
}

bool buildTables(const Build<3>& build)
{
  const std::int64_t columns = build.Tables.Cells[0];
  const std::int64_t rows = build.Tables.Cells[1];
  const std::int64_t slices = build.Tables.Cells[2];
  const std::int64_t sliceCells = columns * rows;
  const std::int64_t strips = (rows + stripRows - 1) / stripRows;
  const std::int64_t slab =
    std::min(slices, std::max<std::int64_t>(1, slabBytes / 8 / sliceCells));
  LargeBuffer<double> values(slab * sliceCells);
  // Per slice and strip {f, f * centre 1} of every column, then what lies before the strip.
  LargeBuffer<double> sums(slab * strips * columns * 2);
  LargeBuffer<double> before(slab * strips * columns * 4);
  LargeBuffer<double> running(sliceCells * 4);
  std::vector<DensitySummary> found(static_cast<std::size_t>(slab * strips));
  std::fill_n(running.data(), running.size(), 0.0);
  for (int level = 0; level < build.Tables.LevelCount; ++level)
  {
    std::fill_n(build.Level(level), build.Tables.Levels[level].Stride[2], 0.0);
  }
  const AddTableRow3D addRow = flowKernels().AddRow3D;

  for (std::int64_t begin = 0; begin < slices;)
  {
    const std::int64_t count = std::min({ slab, slices - begin, build.Pace.NextSlice(1) });
    build.Run.For(count * strips, 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t task = first; task < last; ++task)
      {
        const std::int64_t k = task / strips;
        const std::int64_t firstRow = task % strips * stripRows;
        const std::int64_t lastRow = std::min(firstRow + stripRows, rows);
        double* column = sums.data() + task * columns * 2;
        double* columnMoment = column + columns;
        std::fill_n(column, 2 * columns, 0.0);
        DensitySummary part;
        for (std::int64_t j = firstRow; j < lastRow; ++j)
        {
          const std::int64_t row = (begin + k) * rows + j;
          double* cells = values.data() + k * sliceCells + j * columns;
          build.Density.ReadRow(row, 0, columns, cells);
          part.Total += inspectCells(cells, columns, row * columns,
            build.Occupied + row * build.Tables.WordsPerRow, part)
                          .Sum;
          flowKernels().AddColumns(
            cells, columns, static_cast<double>(j) + 0.5, column, columnMoment);
        }
        found[task] = part;
      }
    });
    for (std::int64_t task = 0; task < count * strips; ++task)
    {
      merge(found[task], build.Found);
    }
    // The sums of the rows before each strip, as prefixes along axis 0.
    build.Run.For(count, 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t k = first; k < last; ++k)
      {
        double* previous = before.data() + k * strips * columns * 4;
        std::fill_n(previous, columns * 4, 0.0);
        for (std::int64_t strip = 1; strip < strips; ++strip)
        {
          const double* column = sums.data() + (k * strips + strip - 1) * columns * 2;
          double* next = previous + columns * 4;
          double sum = 0.0;
          double moment = 0.0;
          double momentAcross = 0.0;
          for (std::int64_t i = 0; i < columns; ++i)
          {
            sum += column[i] * build.Scale;
            moment += column[i] * build.Scale * (static_cast<double>(i) + 0.5);
            momentAcross += column[columns + i] * build.Scale;
            next[4 * i] = previous[4 * i] + sum;
            next[4 * i + 1] = previous[4 * i + 1] + moment;
            next[4 * i + 2] = previous[4 * i + 2] + momentAcross;
            next[4 * i + 3] = next[4 * i];
          }
          previous = next;
        }
      }
    });
    build.Run.For(strips, 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t strip = first; strip < last; ++strip)
      {
        const std::int64_t firstRow = strip * stripRows;
        const std::int64_t lastRow = std::min(firstRow + stripRows, rows);
        TableRow3D row;
        row.Scale = build.Scale;
        row.Count = columns;
        row.Stream = build.Tables.BeyondCaches;
        for (std::int64_t k = 0; k < count; ++k)
        {
          const std::int64_t plane = begin + k + 1;
          row.Columns = before.data() + (k * strips + strip) * columns * 4;
          row.Centre[1] = static_cast<double>(begin + k) + 0.5;
          for (std::int64_t j = firstRow; j < lastRow; ++j)
          {
            row.Values = values.data() + k * sliceCells + j * columns;
            row.Centre[0] = static_cast<double>(j) + 0.5;
            row.Running = running.data() + j * columns * 4;
            row.Nodes = build.Nodes + plane * build.Tables.Levels[0].Stride[2] +
              (j + 1) * build.Tables.Levels[0].Stride[1] + 4;
            addRow(row);
            for (int level = 0; level < build.Tables.LevelCount; ++level)
            {
              const std::int64_t coarsePlane = coarseNode(plane, slices, level);
              const std::int64_t coarseRow = coarseNode(j + 1, rows, level);
              if (coarsePlane < 0)
              {
                continue;
              }
              const auto& stride = build.Tables.Levels[level].Stride;
              double* target = build.Level(level) + coarsePlane * stride[2];
              if (j == 0)
              {
                std::fill_n(target, stride[1], 0.0);
              }
              if (coarseRow >= 0)
              {
                target += coarseRow * stride[1];
                std::fill_n(target, 4, 0.0);
                if (level > 0)
                {
                  copyToLevel<4>(row.Running, 0, columns, columns, level, target);
                }
              }
            }
          }
        }
      }
      fenceStreams();
    });
    begin += count;
    if (!build.Pace.EndSlice(count))
    {
      return false;
    }
  }
  return true;
}

}

template <int Dimension>
SummedAreaTables<Dimension>::SummedAreaTables(
  const DensitySource<Dimension>& density, const Executor& executor, Pacer& pacer)
{
  this->Allocate(density.Size());
  if (!this->Build(density, 1.0, executor, pacer))
  {
    return;
  }
  const DensitySummary& found = this->Found;
  if (found.NotFinite > 0 || found.Negative > 0 || !(found.Total > 0.0) || std::isinf(found.Total))
  {
    throw InvalidDensity(found);
  }
  // Moments of very large values overflow, those of very small ones lose bits: a power of two
  // brings both back without changing a bit of what is computed.
  constexpr double extreme = 1e200;
  if (found.Maximum > extreme || found.Maximum < 1.0 / extreme)
  {
    const double scale = std::ldexp(1.0, std::max(-1000, std::min(1000, -std::ilogb(found.Maximum))));
    if (!this->Build(density, scale, executor, pacer))
    {
      return;
    }
  }

  TableView<Dimension>& tables = this->Tables;
  std::int64_t node = 0;
  std::int64_t cells = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    node += tables.Cells[axis] *
      (axis == 0 ? std::int64_t{ TableView<Dimension>::Record } : tables.Levels[0].Stride[axis]);
    cells *= tables.Cells[axis];
  }
  const double* last = this->Nodes.data() + node;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    tables.Centroid[axis] = last[1 + axis] / last[0];
  }
  constexpr double roundingShare = 2e-15;
  tables.VoidMass = roundingShare * last[0];
  bool full = true;
  for (std::int64_t word = 0; word < this->Occupied.size() && full; ++word)
  {
    full = this->Occupied.data()[word] == ~std::uint64_t{ 0 };
  }
  tables.Occupied = full ? nullptr : this->Occupied.data();
  this->Complete = true;
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
  double estimate = TableView<Dimension>::Record;
  std::int64_t rows = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    tables.Cells[axis] = size[axis];
    tables.Size[axis] = static_cast<double>(size[axis]);
    tables.EvenLevels[axis] = size[axis] % (std::int64_t{ 1 } << ((tables.LevelCount - 1) * levelShift)) == 0;
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
  this->Nodes = LargeBuffer<double>(total);
  for (int level = 0; level < tables.LevelCount; ++level)
  {
    tables.Levels[level].Nodes = this->Nodes.data() + offset[level];
  }
  tables.WordsPerRow = (size[0] + 63) / 64;
  this->Occupied = LargeBuffer<std::uint64_t>(tables.WordsPerRow * rows);
}

template <int Dimension>
bool SummedAreaTables<Dimension>::Build(const DensitySource<Dimension>& density, double scale,
  const Executor& executor, Pacer& pacer)
{
  this->Found = {};
  pacer.BeginStage(1.0, this->Tables.Cells[Dimension > 1 ? Dimension - 1 : 0]);
  return buildTables(RectifiedTransport::Build<Dimension>{ density, scale, executor, pacer,
    this->Tables, this->Nodes.data(), this->Occupied.data(), this->Found });
}

template class SummedAreaTables<1>;
template class SummedAreaTables<2>;
template class SummedAreaTables<3>;

}
