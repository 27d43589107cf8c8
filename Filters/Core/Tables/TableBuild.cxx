// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/TableBuild.h"

#include "Core/Parallel/Executor.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/DensityInspection.h"
#include "Core/Tables/Kernels/TableKernels.h"

#include <algorithm>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Strips have a fixed size, so that sums have the same bits for every executor.
constexpr std::int64_t stripCells = 256; // along axis 0, in 2D
constexpr std::int64_t stripRows = 32;   // along axis 1, in 3D
constexpr std::int64_t rowsAtOnce = 8;   // in 2D

// A slab has this many cells for each thread, for at most so many threads: barriers are few, and
// the cells of a slab stay in the caches between its passes.
constexpr std::int64_t shareCells = std::int64_t{ 1 } << 16;
constexpr std::int64_t mostShares = 8;

// Returns the number of a node on a level, or -1 if the level does not have it. The last node of
// the domain belongs to every level, even if the width does not divide the size.
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

// Returns the number of rows or slices in a slab; each has `cellsOfEach` cells.
std::int64_t slabOf(std::int64_t count, std::int64_t cellsOfEach, const Executor& threads)
{
  const std::int64_t shares = std::clamp<std::int64_t>(threads.Concurrency(), 1, mostShares);
  return std::min(count, std::max<std::int64_t>(1, shares * shareCells / cellsOfEach));
}

// Calls work(task) for all tasks, in any order, until the run is cancelled.
template <class Work>
void forTasks(std::int64_t tasks, Progress& progress, const Work& work)
{
  progress.Threads().For(tasks, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t task = first; task < last && !progress.ShouldStop(); ++task)
    {
      work(task);
    }
  });
}

// Nodes in memory that may be new. The system clears new memory page by page at the first write. If
// several threads write to the same new huge page at once, each clears a page, and all except one
// are thrown away. Hence one thread touches every page before several write to it.
class NewNodes
{
public:
  // Begins at a node; nodes are in the order of their addresses.
  explicit NewNodes(double* nodes)
    : Next(nodes)
  {
  }

  // The number of pages to touch that begin in the nodes up to an end; 0 for one thread.
  std::int64_t PagesUpTo(const double* end, const Executor& threads) const
  {
    return threads.Concurrency() > 1 ? pageFrom(end) - pageFrom(this->Next) : 0;
  }
  // Writes to one of these pages. Call it before anything else is written to these nodes.
  void Touch(std::int64_t page) const
  {
    const std::int64_t address = (pageFrom(this->Next) + page) * pageBytes;
    this->Next[(address - addressOf(this->Next)) / doubleBytes] = 0.0;
  }
  // Continues with the nodes from there on.
  void Pass(double* end) { this->Next = end; }

private:
  // The size of huge pages on x86-64, 2 MiB.
  static constexpr std::int64_t pageBytes = std::int64_t{ 1 } << 21;
  static constexpr auto doubleBytes = static_cast<std::int64_t>(sizeof(double));

  static std::int64_t addressOf(const double* node)
  {
    return static_cast<std::int64_t>(reinterpret_cast<std::uintptr_t>(node));
  }
  // The number of the first page that begins at a node or after it.
  static std::int64_t pageFrom(const double* node)
  {
    return (addressOf(node) + pageBytes - 1) / pageBytes;
  }

  double* Next;
};

// Common parts of the tables in 2D and 3D. A slab of layers along the last axis takes two passes:
// the sums before every strip, then all strips in parallel.
template <int Dimension>
class SlabBuilder
{
protected:
  // A slab has at most `slab` layers. `sumsOfLayer` is the number of sums that inspect the cells of
  // a layer.
  SlabBuilder(const TableBuild<Dimension>& build, std::int64_t slab, std::int64_t sumsOfLayer)
    : Build(build)
    , Slab(slab)
    , SumsOfLayer(sumsOfLayer)
    , Found(static_cast<std::size_t>(slab * sumsOfLayer))
    , Untouched(build.Nodes)
  {
    // The nodes on the lower face of the domain are 0, on all levels.
    for (int level = 0; level < build.Tables.LevelCount; ++level)
    {
      std::fill_n(build.Level(level), build.Tables.Levels[level].Stride[axis], 0.0);
    }
  }

  // Calls sum(number) for the sums of each slab, `atOnce` of them a task, and then add().
  template <class Sum, class Add>
  void ForSlabs(std::int64_t atOnce, const Sum& sum, const Add& add)
  {
    Progress& progress = this->Build.Work;
    const std::int64_t layers = this->Build.Tables.Cells[axis];
    while (this->Begin < layers)
    {
      this->Count = std::min({ this->Slab, layers - this->Begin, progress.NextSlice(this->Slab) });
      double* nodesEnd = this->Build.Nodes +
        (this->Begin + this->Count + 1) * this->Build.Tables.Levels[0].Stride[axis];
      const std::int64_t pages = this->Untouched.PagesUpTo(nodesEnd, progress.Threads());
      const std::int64_t sums = this->Count * this->SumsOfLayer;
      // Touching new pages and summing cells are independent, so one loop has both kinds of tasks.
      forTasks(pages + (sums + atOnce - 1) / atOnce, progress, [&](std::int64_t task) {
        if (task < pages)
        {
          this->Untouched.Touch(task);
          return;
        }
        const std::int64_t first = (task - pages) * atOnce;
        for (std::int64_t i = first; i < std::min(first + atOnce, sums); ++i)
        {
          sum(i);
        }
      });
      this->Untouched.Pass(nodesEnd);
      // Merged in the order of the sums, for the same bits with any number of threads.
      for (std::int64_t i = 0; i < sums; ++i)
      {
        merge(this->Found[static_cast<std::size_t>(i)], this->Build.Found);
      }
      add();
      this->Begin += this->Count;
      progress.EndSlice(this->Count);
    }
  }

  const TableBuild<Dimension>& Build;
  const std::int64_t Slab; // layers, at most
  const std::int64_t SumsOfLayer;
  std::int64_t Begin = 0;            // first layer of the slab
  std::int64_t Count = 0;            // layers in it
  std::vector<DensitySummary> Found; // a summary for each sum of the slab

private:
  static constexpr int axis = Dimension - 1; // across the layers

  NewNodes Untouched;
};

// Slabs of rows: first the sums of each row's cells before every strip, then all strips in
// parallel.
class Builder2D : SlabBuilder<2>
{
public:
  explicit Builder2D(const TableBuild<2>& build)
    : SlabBuilder(
        build, slabOf(build.Tables.Cells[1], build.Tables.Cells[0], build.Work.Threads()), 1)
    , Columns(build.Tables.Cells[0])
    , Rows(build.Tables.Cells[1])
    , Strips((this->Columns + stripCells - 1) / stripCells)
    , Values(this->Slab * this->Columns)
    , Prefixes(this->Slab * this->Strips * 2)
  {
  }

  void Run()
  {
    this->ForSlabs(
      rowsAtOnce, [this](std::int64_t row) { this->SumRow(row); },
      [this]() {
        forTasks(
          this->Strips, this->Build.Work, [this](std::int64_t strip) { this->AddStrip(strip); });
      });
  }

private:
  // Sums row j of the slab: `Prefixes` gets {sum of f, sum of f x_0} before each strip.
  void SumRow(std::int64_t j)
  {
    const std::int64_t row = this->Begin + j;
    double* cells = this->Values.data() + j * this->Columns;
    double sum = 0.0;
    double moment = 0.0;
    DensitySummary part;
    for (std::int64_t strip = 0; strip < this->Strips; ++strip)
    {
      const std::int64_t start = strip * stripCells;
      const std::int64_t length = std::min(stripCells, this->Columns - start);
      this->Build.Density.Read(row * this->Columns + start, length, cells + start);
      double* prefix = this->Prefixes.data() + (j * this->Strips + strip) * 2;
      prefix[0] = sum;
      prefix[1] = moment;
      const RowInspection sums = inspectCells(cells + start, length, row * this->Columns + start,
        this->Build.Occupied + row * this->Build.Tables.WordsPerRow + start / 64, part);
      sum += sums.Sum;
      // A strip's moment is about its own first cell; its sum times the start moves it to the
      // origin: sum of f (x + start) = moment + start * sum.
      moment += sums.Moment + sums.Sum * static_cast<double>(this->Build.Origin[0] + start);
    }
    part.Total = sum;
    this->Found[j] = part;
  }

  // Adds the rows of the slab to the nodes of one strip, from below to above. Strips share no
  // nodes, and each row needs only the row of nodes below it.
  void AddStrip(std::int64_t strip)
  {
    const TableView<2>& tables = this->Build.Tables;
    const std::int64_t start = strip * stripCells;
    TableRow2D row;
    row.First = this->Build.Origin[0] + start;
    row.Count = std::min(stripCells, this->Columns - start);
    for (std::int64_t j = 0; j < this->Count; ++j)
    {
      const std::int64_t node = this->Begin + j + 1;
      row.Values = this->Values.data() + j * this->Columns + start;
      std::copy_n(this->Prefixes.data() + (j * this->Strips + strip) * 2, 2, row.Prefix);
      row.Centre = static_cast<double>(this->Build.Origin[1] + this->Begin + j) + 0.5;
      row.Nodes = this->Build.Nodes + node * tables.Levels[0].Stride[1] + (start + 1) * 4;
      row.Below = row.Nodes - tables.Levels[0].Stride[1];
      this->AddRow(row);
      for (int level = 0; level < tables.LevelCount; ++level)
      {
        const std::int64_t coarse = coarseNode(node, this->Rows, level);
        if (coarse < 0)
        {
          continue;
        }
        double* target = this->Build.Level(level) + coarse * tables.Levels[level].Stride[1];
        // The first strip also writes the node at the face x_0 = 0, where all sums are 0.
        if (strip == 0)
        {
          std::fill_n(target, 4, 0.0);
        }
        if (level > 0)
        {
          copyToLevel<4>(row.Nodes, start, row.Count, this->Columns, level, target);
        }
      }
    }
  }

  const AddTableRow2D AddRow = tableKernels().AddRow2D;
  const std::int64_t Columns;
  const std::int64_t Rows;
  const std::int64_t Strips;
  LargeBuffer<double> Values;
  LargeBuffer<double> Prefixes;
};

// Slabs of slices: first the sums of each strip's columns, then those of the columns before every
// strip, then all strips in parallel.
class Builder3D : SlabBuilder<3>
{
public:
  explicit Builder3D(const TableBuild<3>& build)
    : SlabBuilder(build,
        slabOf(build.Tables.Cells[2], build.Tables.Cells[0] * build.Tables.Cells[1],
          build.Work.Threads()),
        (build.Tables.Cells[1] + stripRows - 1) / stripRows)
    , Columns(build.Tables.Cells[0])
    , Rows(build.Tables.Cells[1])
    , Slices(build.Tables.Cells[2])
    , Strips(this->SumsOfLayer)
    , Values(this->Slab * this->Columns * this->Rows)
    , Sums(this->Slab * this->Strips * this->Columns * 2)
    , Before(this->Slab * this->Strips * this->Columns * 4)
  {
  }

  void Run()
  {
    this->ForSlabs(
      1, [this](std::int64_t task) { this->SumStrip(task); },
      [this]() {
        Progress& progress = this->Build.Work;
        forTasks(this->Count, progress, [this](std::int64_t k) { this->SumBefore(k); });
        forTasks(this->Strips, progress, [this](std::int64_t strip) { this->AddStrip(strip); });
      });
  }

private:
  // Sums one strip of one slice: {f, f * centre 1} of every column.
  void SumStrip(std::int64_t task)
  {
    const std::int64_t k = task / this->Strips;
    const std::int64_t firstRow = task % this->Strips * stripRows;
    const std::int64_t lastRow = std::min(firstRow + stripRows, this->Rows);
    double* column = this->Sums.data() + task * this->Columns * 2;
    double* columnMoment = column + this->Columns;
    std::fill_n(column, 2 * this->Columns, 0.0);
    DensitySummary part;
    for (std::int64_t j = firstRow; j < lastRow; ++j)
    {
      const std::int64_t row = (this->Begin + k) * this->Rows + j;
      double* cells = this->Values.data() + (k * this->Rows + j) * this->Columns;
      this->Build.Density.Read(row * this->Columns, this->Columns, cells);
      const RowInspection sums = inspectCells(cells, this->Columns, row * this->Columns,
        this->Build.Occupied + row * this->Build.Tables.WordsPerRow, part);
      part.Total += sums.Sum;
      this->AddColumns(cells, this->Columns, static_cast<double>(this->Build.Origin[1] + j) + 0.5,
        column, columnMoment);
    }
    this->Found[task] = part;
  }

  // Computes the records of the rows of a slice before each strip, as prefix sums along axis 0 of
  // the columns' sums. The fourth entry is that of the mass; the kernel multiplies it by the
  // slice's centre.
  void SumBefore(std::int64_t k)
  {
    double* previous = this->Before.data() + k * this->Strips * this->Columns * 4;
    std::fill_n(previous, this->Columns * 4, 0.0);
    for (std::int64_t strip = 1; strip < this->Strips; ++strip)
    {
      const double* column = this->Sums.data() + (k * this->Strips + strip - 1) * this->Columns * 2;
      double* next = previous + this->Columns * 4;
      double sum = 0.0;
      double moment = 0.0;
      double momentAcross = 0.0;
      for (std::int64_t i = 0; i < this->Columns; ++i)
      {
        sum += column[i];
        moment += column[i] * (static_cast<double>(this->Build.Origin[0] + i) + 0.5);
        momentAcross += column[this->Columns + i];
        next[4 * i] = previous[4 * i] + sum;
        next[4 * i + 1] = previous[4 * i + 1] + moment;
        next[4 * i + 2] = previous[4 * i + 2] + momentAcross;
        next[4 * i + 3] = next[4 * i];
      }
      previous = next;
    }
  }

  // Adds the slices of the slab to the nodes of one strip of rows. `Columns` begins with the
  // records before the strip, and the kernel adds row after row to it.
  void AddStrip(std::int64_t strip)
  {
    const auto& stride = this->Build.Tables.Levels[0].Stride;
    const std::int64_t firstRow = strip * stripRows;
    const std::int64_t lastRow = std::min(firstRow + stripRows, this->Rows);
    TableRow3D row;
    row.First = this->Build.Origin[0];
    row.Count = this->Columns;
    for (std::int64_t k = 0; k < this->Count; ++k)
    {
      const std::int64_t plane = this->Begin + k + 1;
      row.Columns = this->Before.data() + (k * this->Strips + strip) * this->Columns * 4;
      row.Centre[1] = static_cast<double>(this->Build.Origin[2] + this->Begin + k) + 0.5;
      for (std::int64_t j = firstRow; j < lastRow; ++j)
      {
        row.Values = this->Values.data() + (k * this->Rows + j) * this->Columns;
        row.Centre[0] = static_cast<double>(this->Build.Origin[1] + j) + 0.5;
        row.Nodes = this->Build.Nodes + plane * stride[2] + (j + 1) * stride[1] + 4;
        row.Below = row.Nodes - stride[2];
        this->AddRow(row);
        this->CopyToLevels(row.Nodes, plane, j + 1);
      }
    }
  }

  // Copies the row `nodeRow` of plane `plane` to the levels that have it; the first row brings the
  // row of zeros below it.
  void CopyToLevels(const double* nodes, std::int64_t plane, std::int64_t nodeRow)
  {
    const TableView<3>& tables = this->Build.Tables;
    for (int level = 0; level < tables.LevelCount; ++level)
    {
      const std::int64_t coarsePlane = coarseNode(plane, this->Slices, level);
      const std::int64_t coarseRow = coarseNode(nodeRow, this->Rows, level);
      if (coarsePlane < 0)
      {
        continue;
      }
      const auto& stride = tables.Levels[level].Stride;
      double* target = this->Build.Level(level) + coarsePlane * stride[2];
      if (nodeRow == 1)
      {
        std::fill_n(target, stride[1], 0.0);
      }
      if (coarseRow >= 0)
      {
        target += coarseRow * stride[1];
        std::fill_n(target, 4, 0.0);
        if (level > 0)
        {
          copyToLevel<4>(nodes, 0, this->Columns, this->Columns, level, target);
        }
      }
    }
  }

  const AddToColumns AddColumns = tableKernels().AddColumns;
  const AddTableRow3D AddRow = tableKernels().AddRow3D;
  const std::int64_t Columns;
  const std::int64_t Rows;
  const std::int64_t Slices;
  const std::int64_t Strips;
  LargeBuffer<double> Values;
  LargeBuffer<double> Sums;   // {f, f * centre 1} of the columns, for each slice and strip
  LargeBuffer<double> Before; // records of the columns before each strip, within the slice
};

} // namespace

// A line has no tiles, so that moments are about its first node and Origin is 0.
void buildTables(const TableBuild<1>& build)
{
  const std::int64_t size = build.Tables.Cells[0];
  constexpr std::int64_t segment = 1 << 16;
  // In 1D, one running sum is as fast as memory; the segments bound the memory and the time between
  // checks for cancellation.
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
    build.Work.NextSlice(1);
    const std::int64_t count = std::min(segment, size - first);
    build.Density.Read(first, count, values.data());
    DensitySummary part;
    part.Total = inspectCells(values.data(), count, first, build.Occupied + first / 64, part).Sum;
    merge(part, build.Found);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const double value = values[i];
      sum += value;
      moment += value * (static_cast<double>(first + i) + 0.5);
      nodes[2 * i] = sum;
      nodes[2 * i + 1] = moment;
    }
    for (int level = 0; level < build.Tables.LevelCount; ++level)
    {
      copyToLevel<2>(nodes.data(), first, count, size, level, build.Level(level));
    }
    build.Work.EndSlice(count);
  }
}

void buildTables(const TableBuild<2>& build)
{
  Builder2D(build).Run();
}

void buildTables(const TableBuild<3>& build)
{
  Builder3D(build).Run();
}

} // namespace RectifiedTransport
