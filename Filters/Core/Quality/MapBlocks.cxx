// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Quality/MapBlocks.h"

#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Parallel/Stages.h"
#include "Core/Quality/BlockImages.h"
#include "Core/Quality/BoundaryIntegrals.h"
#include "Core/Quality/DensityRows.h"
#include "Core/Quality/LayerBins.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t blockGrain = 64; // blocks or faces a chunk

template <int Dimension>
class BlocksRun
{
public:
  BlocksRun(const MapSamples<Dimension>& map, const DensitySource<Dimension>& density, double total,
    const Ranks& ranks)
    : Map(map)
    , Images(map)
    , Group(ranks)
    , Size(density.Size)
    , Distributed(density.IsDistributed())
    , Cells(map.Lattice, density.Size)
    , Rows(density, total)
    , Blocks(MapBlocks<Dimension>::Of(map.Lattice, map.Own))
    , Count(this->Blocks.IsEmpty() ? 0 : this->Blocks.Count())
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Faces[axis] = this->Blocks;
      // n blocks along an axis have n + 1 faces across it; each starts with the integral 0.
      ++this->Faces[axis].Cells[axis];
      this->Through[axis].assign(
        static_cast<std::size_t>(this->Count > 0 ? this->Faces[axis].Count() : 0), 0.0);
    }
  }

  // `shares` are the wanted shares of the mass in the images of the blocks, negative for blocks
  // that do not count. If empty, they are the blocks' shares of the domain.
  BlockErrors Forward(Progress& progress, std::vector<double> shares = {})
  {
    this->Wanted = std::move(shares);
    Stages stages(progress, { { "cells", 1 }, { "masses", 99 } });
    // The density is read only where the images of this rank's blocks lie.
    const LatticePart<Dimension> cells = this->CellsAround(stages["cells"]);
    // In 1D and 2D, the integrals over faces are exact. Each face is integrated once and used by
    // both of its blocks.
    if constexpr (Dimension < 3)
    {
      std::vector<LayerBins> faces;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        faces.push_back(this->FacesByLayer(axis, cells, stages["cells"]));
      }
      this->InLayers(cells, stages["masses"], [&](const LayerSpan& batch, Progress& work) {
        // The density in the rows of this batch; parts of faces in other rows come with other
        // batches.
        const MassIntegral<Dimension> mass(this->Rows);
        for (int axis = 0; axis < Dimension; ++axis)
        {
          const std::vector<std::int64_t>& found = faces[static_cast<std::size_t>(axis)].In(batch);
          this->AddThrough(
            mass, axis, static_cast<std::int64_t>(found.size()),
            [&found](std::int64_t i) { return found[static_cast<std::size_t>(i)]; }, work);
        }
      });
      const auto errorOf = [&](std::int64_t block) {
        return this->MassError(block, this->Inside(this->Blocks.CellOf(block)));
      };
      return largestErrors(countedOf(this->Errors(errorOf, stages["masses"])), this->Group);
    }
    else
    {
      return this->ForwardInSpace(cells, stages["masses"]);
    }
  }

  // Returns the masses of the blocks, negative for those that do not count.
  std::vector<double> Masses(Progress& progress)
  {
    const auto count = static_cast<std::size_t>(this->Count);
    std::vector<double> masses(count, 0.0);
    // The least value of a cell under each block decides whether the block counts.
    std::vector<double> least(count, std::numeric_limits<double>::infinity());
    this->InLayers(
      this->Cells.Of(this->Blocks), progress, [&](const LayerSpan& batch, Progress& work) {
        // A block may reach into several batches, and each adds the mass in its own rows.
        const auto blocks = this->BlocksIn(batch);
        const std::int64_t begin = blocks[0];
        work.For(blocks[1] - begin, blockGrain, [&](std::int64_t first, std::int64_t last) {
          for (std::int64_t i = begin + first; i < begin + last; ++i)
          {
            const auto at = static_cast<std::size_t>(i);
            this->Cells.AddMass(this->Blocks.CellOf(i), this->Rows, masses[at], least[at]);
          }
        });
      });
    for (std::size_t i = 0; i < count; ++i)
    {
      // Blocks with thin cells have relative errors without meaning.
      masses[i] = least[i] > leastOfMean * this->Mean() ? masses[i] : Uncounted;
    }
    return masses;
  }

  // Returns the same as shares of the total mass.
  std::vector<double> Shares(Progress& progress)
  {
    std::vector<double> shares = this->Masses(progress);
    for (double& share : shares)
    {
      share = share < 0.0 ? Uncounted : share / this->Rows.TotalMass();
    }
    return shares;
  }

  // Backward, the image of a block at the uniform measure should have the measure mass / mean
  // density.
  BlockErrors Backward(Progress& progress)
  {
    Stages stages(progress, { { "masses", 7 }, { "measures", 3 } });
    const std::vector<double> masses = this->Masses(stages["masses"]);
    Progress& work = stages["measures"];
    for (int axis = 0; axis<Dimension&& this->Count> 0; ++axis)
    {
      this->AddThrough(
        MeasureIntegral(), axis, this->Faces[axis].Count(), [](std::int64_t i) { return i; }, work);
    }
    const auto errorOf = [&](std::int64_t block) {
      const double mass = masses[static_cast<std::size_t>(block)];
      if (mass < 0.0)
      {
        return Uncounted;
      }
      const double wanted = mass / this->Mean(); // wanted measure
      return std::abs(this->Inside(this->Blocks.CellOf(block)) - wanted) / wanted;
    };
    return largestErrors(countedOf(this->Errors(errorOf, work)), this->Group);
  }

private:
  // The mean density, per grid cell.
  double Mean() const { return this->Rows.TotalMass() / numberOfCells<Dimension>(this->Size); }

  // Adds the integrals over faces across an axis, with the numbers numberOf(0 ... count - 1).
  template <class Integral, class NumberOf>
  void AddThrough(const Integral& integral, int axis, std::int64_t count, const NumberOf& numberOf,
    Progress& progress)
  {
    const LatticePart<Dimension>& faces = this->Faces[axis];
    progress.ForEach(
      count, blockGrain,
      [&](std::int64_t i) {
        const std::int64_t face = numberOf(i);
        // The integral of the part of the face's image that is in the current rows.
        this->Through[axis][static_cast<std::size_t>(face)] +=
          this->Images.Across(axis, faces.CellOf(face), integral);
      },
      64 * blockGrain);
  }

  // Sorts items by the layers of the grid that they lie in; `samplesOf` gives an item's samples. If
  // one batch has all layers, every item is in it. In 1D the mass below a layer counts, too.
  template <class SamplesOf>
  LayerBins ByLayer(std::int64_t count, const LatticePart<Dimension>& cells,
    const SamplesOf& samplesOf, Progress& progress)
  {
    std::vector<LayerSpan> spans(
      static_cast<std::size_t>(count), { cells.Low[Last], cells.End(Last) });
    const std::int64_t each = this->Rows.LayersAtOnce();
    if (Dimension > 1 && !cells.IsEmpty() && cells.Low[Last] / each != (cells.End(Last) - 1) / each)
    {
      progress.ForEach(count, blockGrain, [&](std::int64_t i) {
        spans[static_cast<std::size_t>(i)] = this->Images.LayersOf(samplesOf(i), this->Size[Last]);
      });
    }
    return LayerBins(std::move(spans));
  }

  // Sorts the faces across an axis by layers, as ByLayer.
  LayerBins FacesByLayer(int axis, const LatticePart<Dimension>& cells, Progress& progress)
  {
    const LatticePart<Dimension>& faces = this->Faces[axis];
    const auto samplesOf = [&, axis](std::int64_t i) {
      // The samples of a face: those of a block, but only one layer along the axis.
      LatticePart<Dimension> samples =
        MapBlocks<Dimension>::SamplesOf({ faces.CellOf(i), oneBlock() });
      samples.Cells[axis] = 1;
      return samples;
    };
    return this->ByLayer(this->Count > 0 ? faces.Count() : 0, cells, samplesOf, progress);
  }

  // Returns the first block that covers cells of a batch of layers, and the end: blocks are
  // numbered by layers of blocks.
  std::array<std::int64_t, 2> BlocksIn(const LayerSpan& batch) const
  {
    // The cells under a layer of blocks, along the last axis.
    const auto lies = [&](std::int64_t layer) { return this->Cells.Covered(Last, layer); };
    std::int64_t low = this->Blocks.Low[Last];
    std::int64_t high = this->Blocks.End(Last);
    while (low < high && lies(low).End <= batch.First)
    {
      ++low;
    }
    while (low < high && lies(high - 1).First >= batch.End)
    {
      --high;
    }
    // Blocks in a layer.
    const std::int64_t inLayer = this->Count / std::max<std::int64_t>(1, this->Blocks.Cells[Last]);
    return { (low - this->Blocks.Low[Last]) * inLayer, (high - this->Blocks.Low[Last]) * inLayer };
  }

  // In 3D, first a fast pass for all blocks by one point a triangle, then exact integration of the
  // blocks that seem to have the largest errors.
  BlockErrors ForwardInSpace(const LatticePart<Dimension>& cells, Progress& progress)
  {
    // The worst twentieth is integrated exactly, fifty times as many blocks as the quantile needs.
    constexpr std::int64_t partExactly = 20;
    const Ranks& ranks = this->Group;
    Stages stages(progress, { { "all", 1 }, { "largest", 1 } });
    std::vector<double> masses(static_cast<std::size_t>(this->Count), 0.0);
    // All blocks in the first pass, the worst ones in the second.
    std::vector<std::int64_t> blocks(masses.size());
    std::iota(blocks.begin(), blocks.end(), std::int64_t{ 0 });
    this->AddInLayers(cells, blocks, TriangleRule::Centroid, masses, stages["all"]);
    const auto errorOf = [&](std::int64_t block) {
      return this->MassError(block, masses[static_cast<std::size_t>(block)]);
    };
    // Approximate relative errors, which only select the blocks for exact integration.
    std::vector<double> errors = this->Errors(errorOf, stages["all"]);
    const std::vector<double> own = countedOf(errors);
    const std::int64_t all = sumOverRanks(ranks, static_cast<std::int64_t>(own.size()));
    const std::vector<double> largest =
      largestOf(own, (all + partExactly - 1) / partExactly, ranks);
    if (largest.empty())
    {
      return {};
    }
    // The smallest of the largest errors of all ranks: this rank's blocks above it are integrated
    // again.
    const double least = *std::min_element(largest.begin(), largest.end());
    blocks.clear();
    for (std::int64_t block = 0; block < this->Count; ++block)
    {
      if (errors[static_cast<std::size_t>(block)] >= least)
      {
        blocks.push_back(block);
        masses[static_cast<std::size_t>(block)] = 0.0;
      }
    }
    this->AddInLayers(cells, blocks, TriangleRule::Exact, masses, stages["largest"]);
    // All other blocks count as better than these.
    std::transform(errors.begin(), errors.end(), errors.begin(),
      [](double e) { return e < 0.0 ? Uncounted : 0.0; });
    for (const std::int64_t block : blocks)
    {
      errors[static_cast<std::size_t>(block)] = errorOf(block);
    }
    return largestErrors(countedOf(std::move(errors)), ranks);
  }

  // Adds the masses in the images of blocks, batch by batch.
  void AddInLayers(const LatticePart<Dimension>& cells, const std::vector<std::int64_t>& blocks,
    TriangleRule rule, std::vector<double>& masses, Progress& progress)
  {
    const auto samplesOf = [&](std::int64_t i) {
      const std::int64_t number = blocks[static_cast<std::size_t>(i)];
      return MapBlocks<Dimension>::SamplesOf({ this->Blocks.CellOf(number), oneBlock() });
    };
    Stages stages(progress, { { "order", 1 }, { "masses", 99 } });
    LayerBins items =
      this->ByLayer(static_cast<std::int64_t>(blocks.size()), cells, samplesOf, stages["order"]);
    this->InLayers(cells, stages["masses"], [&](const LayerSpan& batch, Progress& work) {
      std::vector<std::int64_t> found = items.In(batch);
      std::transform(found.begin(), found.end(), found.begin(),
        [&](std::int64_t i) { return blocks[static_cast<std::size_t>(i)]; });
      this->AddInside(found, rule, masses, work);
    });
  }

  // Adds the masses in the rows that are held. Sums along rows begin in the block's middle, so that
  // they are small and their differences between rows, too.
  void AddInside(const std::vector<std::int64_t>& blocks, TriangleRule rule,
    std::vector<double>& masses, Progress& progress)
  {
    constexpr std::int64_t size = MapBlocks<Dimension>::Size;
    progress.ForEach(
      static_cast<std::int64_t>(blocks.size()), blockGrain,
      [&](std::int64_t i) {
        const std::int64_t number = blocks[static_cast<std::size_t>(i)];
        const GridSize<Dimension> block = this->Blocks.CellOf(number);
        GridSize<Dimension> middle = block;
        for (std::int64_t& sample : middle)
        {
          sample = size * sample + size / 2;
        }
        // Prefix sums start at the image of the block's central sample.
        const MassIntegral<Dimension> mass(this->Rows, *this->Images.At(middle), rule);
        for (int axis = 0; axis < Dimension; ++axis)
        {
          GridSize<Dimension> above = block;
          ++above[axis];
          masses[static_cast<std::size_t>(number)] +=
            this->Images.Across(axis, above, mass) - this->Images.Across(axis, block, mass);
        }
      },
      16 * blockGrain);
  }

  // Returns the relative error, forward, of the mass in the image of a block.
  double MassError(std::int64_t block, double mass) const
  {
    // A block of 4^D samples has this share of the domain.
    double share = 1.0;
    for (const std::int64_t samples : this->Map.Lattice)
    {
      share *= static_cast<double>(MapBlocks<Dimension>::Size) / static_cast<double>(samples);
    }
    if (!this->Wanted.empty())
    {
      share = this->Wanted[static_cast<std::size_t>(block)];
    }
    return share < 0.0 ? Uncounted : std::abs(mass / this->Rows.TotalMass() - share) / share;
  }

  // Returns the integral over the closed boundary of a block: upper faces minus lower faces
  // (Gauss's theorem).
  double Inside(const GridSize<Dimension>& block) const
  {
    double sum = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      GridSize<Dimension> above = block;
      ++above[axis];
      const auto at = [&](const GridSize<Dimension>& face) {
        return this->Through[axis][static_cast<std::size_t>(this->Faces[axis].NumberOf(face))];
      };
      sum += at(above) - at(block);
    }
    return sum;
  }

  // Returns the grid cells that contain the images of this rank's samples, or a larger part.
  LatticePart<Dimension> CellsAround(Progress& progress)
  {
    if (this->Count == 0 || (!this->Distributed && this->Rows.LayersAtOnce() >= this->Size[Last]))
    {
      return this->Count == 0 ? LatticePart<Dimension>{ {}, {} }
                              : LatticePart<Dimension>::WholeOf(this->Size);
    }
    const LatticePart<Dimension> samples = MapBlocks<Dimension>::SamplesOf(this->Blocks);
    const LatticePart<Dimension> none{ {}, {} };
    // A sample adds the grid cell that its image is in; the join of boxes depends on no order.
    return reduceChunks(
      progress, samples.Count(), 4096, none,
      [&](std::int64_t first, std::int64_t last) {
        LatticePart<Dimension> found = none;
        for (std::int64_t i = first; i < last; ++i)
        {
          const double* x = this->Images.At(samples.CellOf(i));
          LatticePart<Dimension> cell{ {}, oneBlock() };
          for (int axis = 0; axis < Dimension; ++axis)
          {
            cell.Low[axis] =
              std::clamp<std::int64_t>(static_cast<std::int64_t>(x[axis]), 0, this->Size[axis] - 1);
          }
          found = found.With(cell);
        }
        return found;
      },
      [](const LatticePart<Dimension>& a, const LatticePart<Dimension>& b) { return a.With(b); });
  }

  // Calls visit(batch, progress) with the rows of one batch of layers after another. The
  // beginnings of batches do not depend on the cells, so that sums have the same bits on every
  // rank. Collective.
  template <class Visit>
  void InLayers(const LatticePart<Dimension>& cells, Progress& progress, const Visit& visit)
  {
    const std::int64_t each = this->Rows.LayersAtOnce();
    // Batches begin at multiples of their size, on all ranks.
    std::int64_t low = cells.Low[Last] / each * each;
    const std::int64_t count = std::max<std::int64_t>(1, (cells.End(Last) - low + each - 1) / each);
    Parts parts(progress, count);
    for (std::int64_t i = 0; !onAllRanks(this->Group, low >= cells.End(Last)); ++i)
    {
      LatticePart<Dimension> layers = cells;
      layers.Low[Last] = std::min(low, this->Size[Last]);
      layers.Cells[Last] = low < cells.End(Last) ? std::min(each, this->Size[Last] - low) : 0;
      low += each;
      // Other ranks may have more batches, which this rank joins with empty boxes.
      Stages stages(parts[std::min(i, count - 1)], { { "reading", 1 }, { "visit", 4 } });
      this->Rows.Read(layers, stages["reading"]);
      if (!layers.IsEmpty())
      {
        visit(LayerSpan{ layers.Low[Last], layers.End(Last) }, stages["visit"]);
      }
    }
  }

  static GridSize<Dimension> oneBlock()
  {
    GridSize<Dimension> one;
    one.fill(1);
    return one;
  }

  // The error of each of this rank's blocks, negative for those that do not count.
  template <class Error>
  std::vector<double> Errors(const Error& error, Progress& progress)
  {
    std::vector<double> errors(static_cast<std::size_t>(this->Count));
    progress.ForEach(this->Count, 16 * blockGrain,
      [&](std::int64_t i) { errors[static_cast<std::size_t>(i)] = error(i); });
    return errors;
  }

  static constexpr int Last = Dimension - 1;
  const MapSamples<Dimension>& Map;
  const BlockImages<Dimension> Images;
  const Ranks& Group;
  const GridSize<Dimension> Size;
  const bool Distributed;
  const BlockCells<Dimension> Cells;
  DensityRows<Dimension> Rows;
  const LatticePart<Dimension> Blocks;
  const std::int64_t Count;
  std::array<LatticePart<Dimension>, Dimension> Faces; // below blocks along an axis, and the last
  std::array<std::vector<double>, Dimension> Through;  // the integrals over them
  std::vector<double> Wanted;                          // shares of the mass; none: by measure
};

} // namespace

template <int Dimension>
BlockErrors measureBlocks(const MapSamples<Dimension>& map, const DensitySource<Dimension>& density,
  double total, FlowDirection direction, Progress& progress)
{
  BlocksRun<Dimension> run(map, density, total, progress.Group());
  return direction == FlowDirection::Backward ? run.Backward(progress) : run.Forward(progress);
}

template <int Dimension>
BlockErrors measureBlocksBetween(const MapSamples<Dimension>& map,
  const SummedDensity<Dimension>& source, const SummedDensity<Dimension>& target,
  Progress& progress)
{
  const Ranks& ranks = progress.Group();
  Stages stages(progress, { { "shares", 1 }, { "errors", 4 } });
  // The source's shares come first: its rows are released before those of the target are read.
  std::vector<double> shares =
    BlocksRun<Dimension>(map, source.Density, source.Total, ranks).Shares(stages["shares"]);
  return BlocksRun<Dimension>(map, target.Density, target.Total, ranks)
    .Forward(stages["errors"], std::move(shares));
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(measureBlocks);

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(measureBlocksBetween);

} // namespace RectifiedTransport
