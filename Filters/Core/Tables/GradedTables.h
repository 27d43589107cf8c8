// SPDX-License-Identifier: BSD-3-Clause
// Summed-area tables of a whole density (paper, Section 3.3) at few nodes, for wide boxes.
#ifndef RectifiedTransport_GradedTables_h
#define RectifiedTransport_GradedTables_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/DensityInspection.h"
#include "Core/Tables/NodeLayout.h"
#include "Core/Tables/ScaledDensity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace RectifiedTransport
{

// The nodes along one axis of `size` grid cells. They are `stride` cells apart, a power of two, but
// denser towards both faces, because boxes that are cut there are narrow: a cell between nodes is
// one grid cell wide, or at most 1/ratio of its distance from the nearer face.
inline std::vector<std::int64_t> gradedNodes(std::int64_t size, std::int64_t stride, double ratio)
{
  std::vector<std::int64_t> nodes = { 0 };
  std::int64_t width = 1;
  // From the lower face to the middle: the cell's width doubles once a node is 2 * ratio widths
  // away from the face, until it reaches the stride. The nodes of the upper half mirror these.
  while (nodes.back() + width <= size / 2)
  {
    nodes.push_back(nodes.back() + width);
    while (width < stride &&
      static_cast<double>(nodes.back()) >= 2.0 * ratio * static_cast<double>(width))
    {
      width *= 2;
    }
  }
  // The middle part may be up to two widths long; it is halved if it is longer than one.
  const std::int64_t gap = size - 2 * nodes.back();
  const std::size_t below = nodes.size();
  if (gap > width)
  {
    nodes.push_back(nodes.back() + gap / 2);
  }
  for (std::size_t i = below; i-- > 0;)
  {
    if (size - nodes[i] > nodes.back())
    {
      nodes.push_back(size - nodes[i]);
    }
  }
  return nodes;
}

// In 2D and 3D. One record of doubles a node; see TableView.h for its entries. The sums at the
// nodes are those of whole tables. Boxes at least `ratio` strides wide, or cut at a face, are
// interpolated between them. Built in O(cells), in one pass over the density that also inspects it;
// the same bits for every executor.
template <int Dimension>
class GradedTables
{
public:
  // For a distributed density, every rank sums some layers of the grid and gets the tables of all;
  // collective. Throws InvalidDensity, Cancelled and std::bad_alloc.
  GradedTables(const DensitySource<Dimension>& density, const GridSize<Dimension>& strides,
    double ratio, Progress& progress)
  {
    this->Allocate(density.Size, strides, ratio);
    TableView<Dimension>& tables = this->Tables;
    this->Add(density, 0, progress);
    const DensitySummary found = this->Found;
    // Values that are scaled need a second pass: their exponent is known only after the first. The
    // summary remains that of the values as they are.
    requireDensity(found);
    tables.Largest = found.Maximum;
    this->Exponent = scalingOf(found.Maximum);
    if (this->Exponent != 0)
    {
      // The second pass finds scaled values, but the summary describes the density.
      this->Add(density, this->Exponent, progress);
      this->Found = found;
      tables.Largest = std::ldexp(found.Maximum, this->Exponent);
    }
    std::int64_t last = 0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      last +=
        (static_cast<std::int64_t>(this->Nodes[axis].size()) - 1) * tables.Levels[1].Stride[axis];
    }
    setTotals(tables, this->Records.data() + last, this->Occupied.data(), this->Occupied.size());
  }

  const TableView<Dimension>& View() const { return this->Tables; }
  const DensitySummary& Summary() const { return this->Found; }
  // The exponent of the power of two that scales the values in the tables.
  int Scaling() const { return this->Exponent; }
  std::int64_t MemorySize() const
  {
    std::int64_t bytes = this->Records.bytes() + this->Occupied.bytes();
    for (int axis = 0; axis < Dimension; ++axis)
    {
      bytes += static_cast<std::int64_t>(this->NodeBelow[axis].size() * sizeof(std::int32_t) +
        this->Nodes[axis].size() * (sizeof(std::int64_t) + sizeof(double)));
    }
    return bytes;
  }

private:
  static constexpr int record = 4; // doubles, in 2D and 3D

  // Layers of the grid between nodes of the last axis.
  struct Layers
  {
    std::int64_t First;
    std::int64_t End;
  };

  void Allocate(const GridSize<Dimension>& size, const GridSize<Dimension>& strides, double ratio)
  {
    TableView<Dimension>& tables = this->Tables;
    GridSize<Dimension> counts;
    const std::int64_t words = setGrid<Dimension>(tables, size);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Nodes[axis] = gradedNodes(size[axis], strides[axis], ratio);
      const std::vector<std::int64_t>& nodes = this->Nodes[axis];
      counts[axis] = static_cast<std::int64_t>(nodes.size());
      this->Places[axis].assign(nodes.begin(), nodes.end());
      this->NodeBelow[axis].reserve(static_cast<std::size_t>(size[axis]));
      for (std::size_t node = 0; node + 1 < nodes.size(); ++node)
      {
        this->NodeBelow[axis].insert(this->NodeBelow[axis].end(),
          static_cast<std::size_t>(nodes[node + 1] - nodes[node]), static_cast<std::int32_t>(node));
      }
      tables.EvenLevels[axis] = false;
      tables.Uneven[axis] = { this->NodeBelow[axis].data(), this->Places[axis].data() };
    }
    tables.IsUneven = true;
    tables.LevelCount = 2;
    tables.BeyondCaches = false;
    this->Records = LargeBuffer<double>(layOutNodes<Dimension>(counts, tables.Levels[1].Stride));
    tables.Levels[1].Nodes = this->Records.data();
    tables.Levels[0] = tables.Levels[1];
    this->Occupied = LargeBuffer<std::uint64_t>(words);
  }

  // Sums the values, scaled by 2^scaling. Each rank reads the layers that begin in its share of the
  // grid cells along the last axis.
  void Add(const DensitySource<Dimension>& density, int scaling, Progress& progress)
  {
    constexpr int axis = Dimension - 1;
    const Ranks& ranks = progress.Group();
    const Layers own = density.IsDistributed() ? this->LayersOf(ranks, ranks.Own())
                                               : Layers{ 0, this->NumberOfLayers() };
    // A summary for each layer, merged in their order.
    std::vector<DensitySummary> found(static_cast<std::size_t>(this->NumberOfLayers()));
    Stages stages(progress, { { "reading", 9 }, { "sums", 1 } });
    {
      GridSize<Dimension> low{};
      GridSize<Dimension> high = density.Size;
      low[axis] = this->Nodes[axis][static_cast<std::size_t>(own.First)];
      high[axis] = this->Nodes[axis][static_cast<std::size_t>(own.End)];
      const std::shared_ptr<const DensityValues> values = density.Part(low, high);
      this->AddLayers(ScaledDensity(*values, scaling), own, stages["reading"], found);
    }
    if (density.IsDistributed())
    {
      this->GatherLayers(ranks, found);
    }
    this->Found = {};
    for (const DensitySummary& part : found)
    {
      merge(part, this->Found);
    }
    this->SumNodes(stages["sums"]);
  }

  std::int64_t NumberOfLayers() const
  {
    return static_cast<std::int64_t>(this->Nodes[Dimension - 1].size()) - 1;
  }

  Layers LayersOf(const Ranks& ranks, int rank) const
  {
    // Rank r owns the layers whose first cells are in [r, r + 1) * cells / ranks.
    const std::vector<std::int64_t>& nodes = this->Nodes[Dimension - 1];
    const auto layerAt = [&](int end) {
      const std::int64_t cell = nodes.back() * end / ranks.Count();
      return static_cast<std::int64_t>(
        std::lower_bound(nodes.begin(), nodes.end(), cell) - nodes.begin());
    };
    return { layerAt(rank), layerAt(rank + 1) };
  }

  // Sums layers in parallel: a layer writes only the records of the nodes at its upper end.
  void AddLayers(const DensityValues& density, const Layers& layers, Progress& progress,
    std::vector<DensitySummary>& found)
  {
    progress.For(
      layers.End - layers.First, 1,
      [&](std::int64_t first, std::int64_t last) {
        std::vector<double> row(static_cast<std::size_t>(this->Tables.Cells[0]));
        std::vector<std::uint64_t> words(static_cast<std::size_t>(this->Tables.WordsPerRow));
        for (std::int64_t i = first; i < last && !progress.ShouldStop(); ++i)
        {
          const std::int64_t layer = layers.First + i;
          this->AddLayer(density, layer, row.data(), words, found[static_cast<std::size_t>(layer)]);
        }
      },
      2);
  }

  // After this, all ranks have the records, the bits and the summaries of all layers.
  void GatherLayers(const Ranks& ranks, std::vector<DensitySummary>& found)
  {
    constexpr int axis = Dimension - 1;
    const std::vector<std::int64_t>& nodes = this->Nodes[axis];
    const auto nodeOf = [&](std::int64_t layer) { return nodes[static_cast<std::size_t>(layer)]; };
    const std::int64_t stride = this->Tables.Levels[1].Stride[axis];
    const std::int64_t rows = this->Occupied.size() / this->Tables.WordsPerRow / nodes.back();
    const std::int64_t words = this->Tables.WordsPerRow * rows; // words of a slice
    std::fill_n(this->Records.data(), stride, 0.0);
    // Gathers an array that has `each` values for every place along the axis, from all ranks.
    const auto gather = [&](auto* all, std::int64_t each, const auto& placeOf) {
      std::vector<std::int64_t> starts;
      for (int rank = 0; rank <= ranks.Count(); ++rank)
      {
        starts.push_back(placeOf(this->LayersOf(ranks, rank).First) * each);
      }
      gatherParts(ranks, starts, all);
    };
    const auto layerOf = [](std::int64_t layer) { return layer; };
    gather(this->Records.data() + stride, stride, layerOf);
    gather(this->Occupied.data(), words, nodeOf);
    gather(found.data(), 1, layerOf);
  }

  // Sums the grid cells of one layer in the boxes between nodes. The node above a box gets its sum;
  // SumNodes makes prefix sums of these.
  void AddLayer(const DensityValues& density, std::int64_t layer, double* row,
    std::vector<std::uint64_t>& words, DensitySummary& found)
  {
    const auto& stride = this->Tables.Levels[1].Stride;
    constexpr int last = Dimension - 1;
    double* records = this->Records.data() + (layer + 1) * stride[last];
    std::fill_n(records, stride[last], 0.0);
    if (layer == 0)
    {
      std::fill_n(this->Records.data(), stride[last], 0.0);
    }
    const std::int64_t columns = this->Tables.Cells[0];
    const std::int64_t rows = Dimension == 3 ? this->Tables.Cells[1] : 1;
    const std::int64_t end = this->Nodes[last][static_cast<std::size_t>(layer) + 1];
    for (std::int64_t slice = this->Nodes[last][static_cast<std::size_t>(layer)]; slice < end;
         ++slice)
    {
      for (std::int64_t j = 0; j < rows; ++j)
      {
        const std::int64_t number = slice * rows + j;
        density.Read(number * columns, columns, row);
        found.Total += inspectCells(row, columns, number * columns, words.data(), found).Sum;
        std::copy(
          words.begin(), words.end(), this->Occupied.data() + number * this->Tables.WordsPerRow);
        if constexpr (Dimension == 3)
        {
          const double centres[2] = { static_cast<double>(j) + 0.5,
            static_cast<double>(slice) + 0.5 };
          const std::int64_t node = this->NodeBelow[1][static_cast<std::size_t>(j)];
          this->AddRow(row, records + (node + 1) * stride[1], centres);
        }
        else
        {
          const double centre = static_cast<double>(slice) + 0.5;
          this->AddRow(row, records, &centre);
        }
      }
    }
  }

  // Adds one row of cells to the records of its boxes: {E, E_0, E_1, E_2} or, in 2D, {E, E_0, E_1,
  // E}. `centres` are the row's centres along the other axes.
  void AddRow(const double* cells, double* records, const double* centres) const
  {
    const std::vector<std::int64_t>& nodes = this->Nodes[0];
    for (std::size_t node = 0; node + 1 < nodes.size(); ++node)
    {
      double sum = 0.0;
      double moment = 0.0;
      for (std::int64_t i = nodes[node]; i < nodes[node + 1]; ++i)
      {
        sum += cells[i];
        moment += cells[i] * (static_cast<double>(i) + 0.5);
      }
      // The record at the node above the box.
      double* sums = records + (node + 1) * record;
      sums[0] += sum;
      sums[1] += moment;
      sums[2] += sum * centres[0];
      sums[3] += Dimension == 3 ? sum * centres[Dimension - 2] : sum;
    }
  }

  // Makes prefix sums over the nodes, axis by axis: along axes 0 and 1 within each plane, then over
  // the planes. Additions have a fixed order, and every sum is a sum of positive terms.
  void SumNodes(Progress& progress)
  {
    const auto& stride = this->Tables.Levels[1].Stride;
    double* records = this->Records.data();
    const auto add = [](double* to, const double* from, std::int64_t doubles) {
      for (std::int64_t i = 0; i < doubles; ++i)
      {
        to[i] += from[i];
      }
    };
    constexpr int last = Dimension - 1;
    const auto columns = static_cast<std::int64_t>(this->Nodes[0].size());
    const auto planes = static_cast<std::int64_t>(this->Nodes[last].size());
    const std::int64_t rows = Dimension == 3 ? static_cast<std::int64_t>(this->Nodes[1].size()) : 1;
    const Executor& threads = progress.Threads();
    threads.For(planes, 1, [&](std::int64_t first, std::int64_t end) {
      for (std::int64_t plane = first; plane < end; ++plane)
      {
        for (std::int64_t j = 0; j < rows; ++j)
        {
          double* row = records + plane * stride[last] + (Dimension == 3 ? j * stride[1] : 0);
          for (std::int64_t i = 1; i < columns; ++i)
          {
            add(row + i * record, row + (i - 1) * record, record);
          }
          if (j > 0)
          {
            add(row, row - stride[1], columns * record);
          }
        }
      }
    });
    progress.Check();
    threads.For(rows, 1, [&](std::int64_t first, std::int64_t end) {
      for (std::int64_t plane = 1; plane < planes; ++plane)
      {
        for (std::int64_t j = first; j < end; ++j)
        {
          double* row = records + plane * stride[last] + (Dimension == 3 ? j * stride[1] : 0);
          add(row, row - stride[last], columns * record);
        }
      }
    });
    progress.Check();
  }

  // For each axis: the nodes' places in cells, the node below each grid cell, and the same places
  // as doubles for the kernels.
  std::vector<std::int64_t> Nodes[Dimension];
  std::vector<std::int32_t> NodeBelow[Dimension];
  std::vector<double> Places[Dimension];
  LargeBuffer<double> Records;
  LargeBuffer<std::uint64_t> Occupied; // one bit a grid cell
  TableView<Dimension> Tables;
  DensitySummary Found;
  int Exponent = 0;
};

} // namespace RectifiedTransport

#endif
