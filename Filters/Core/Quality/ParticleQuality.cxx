// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Quality/ParticleQuality.h"

#include "Core/Geometry/LengthScale.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankOrder.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"
#include "Core/Quality/BlockShares.h"
#include "Core/Quality/GridBlocks.h"
#include "Core/Quality/NearestNeighbours.h"

#include <atomic>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// A thread takes so many particles or blocks at a time.
constexpr std::int64_t particleGrain = std::int64_t{ 1 } << 12;
constexpr std::int64_t noBlock = -1;
constexpr double farOutside = 1e150; // in sizes of the domain; its square is finite

// The largest nearest-neighbour distance of points with one point in each `measure`, that of the
// densest lattice packing: a regular row, the hexagonal lattice, the face-centred cubic lattice.
// (Lagae and Dutre, "A Comparison of Methods for Generating Poisson Disk Distributions", Computer
// Graphics Forum 27(1), 2008, Section 2.2: twice their r_max.)
template <int Dimension>
double largestSpacing(double measure)
{
  return Dimension == 1 ? measure
    : Dimension == 2    ? std::sqrt(2.0 / std::sqrt(3.0) * measure)
                        : cubeRoot(std::sqrt(2.0) * measure);
}

template <int Dimension>
class QualityRun
{
public:
  QualityRun(const ParticleSample& particles, const RectifiedFlow<Dimension>& flow,
    const ImageGrid& grid, std::int64_t blockSize, const Ranks& ranks)
    : Particles(particles)
    , Flow(flow)
    , Grid(grid)
    , Scale(grid)
    , Blocks(grid.Size<Dimension>(), blockSize)
    , NumberOfBlocks(static_cast<std::int64_t>(this->Blocks.Count()))
    , Group(ranks)
    , OwnBlocks(this->NumberOfBlocks, this->Group)
    , Count(particles.Points.size())
    , Points(3 * this->Count)
    , Block(this->Count)
    , Spacing(this->Count)
    , Found(this->OwnBlocks.Count)
    , Expected(this->OwnBlocks.Count)
  {
  }

  ParticleQuality Measure(Progress& progress)
  {
    Stages stages(progress,
      { { "blocks", 10 }, { "masses", 10 }, { "cost", 5 }, { "shares", 15 }, { "neighbours", 27 },
        { "spacings", 30 }, { "average", 3 } });
    this->Quality.Particles = sumOverRanks(this->Group, this->Count);
    // Values times the measure of a cell, in physical units.
    this->Quality.TotalMass = this->Flow.Total() * this->Grid.CellMeasure();
    this->Place(stages["blocks"]);
    // On several ranks, sums follow a global order of the particles, so that their bits do not
    // depend on how particles are distributed.
    if (this->Group.AreSeveral())
    {
      this->Order.emplace(this->Count, this->Particles.Order, 1, this->Group, stages["masses"]);
    }
    this->AddMasses(stages["masses"]);
    this->MeasureCost(stages["cost"]);
    this->CompareBlocks(stages["shares"]);
    nearestDistances(
      { this->Points.data(), this->Count }, this->Spacing.data(), stages["neighbours"]);
    this->RelateSpacings(stages["spacings"]);
    this->AverageSpacings(stages["average"]);
    return this->Quality;
  }

private:
  // Runs kernel(i) in order on this thread, for sums with a fixed order.
  template <class Kernel>
  void InOrder(std::int64_t count, Progress& progress, const Kernel& kernel)
  {
    progress.ForEachInOrder(count, particleGrain, kernel);
  }

  // Returns the sum of value(i) over the particles of all ranks, in their order.
  template <class Value>
  double SumInOrder(Progress& progress, const Value& value)
  {
    double sum = 0.0;
    if (!this->Order)
    {
      this->InOrder(this->Count, progress, [&](std::int64_t i) { sum += value(i); });
      return sum;
    }
    // Each rank gets a part of the order, and the running sum goes from rank to rank.
    const std::vector<double> share = this->Order->Redistribute(value);
    return sumInTurn(this->Group, sum,
      [&](double& running) { running = std::accumulate(share.begin(), share.end(), running); });
  }

  // Returns the mass of a particle relative to the total.
  double Share(std::int64_t particle) const
  {
    return (this->Particles.Masses ? this->Particles.Masses[particle] : 1.0) / this->ParticleMass;
  }

  // Finds the block that each particle is in.
  void Place(Progress& progress)
  {
    std::atomic<std::int64_t> outside{ 0 };
    std::atomic<std::int64_t> inEmpty{ 0 };
    progress.ForEach(this->Count, particleGrain, [&](std::int64_t i) {
      // Coordinates are scaled by the domain's size, so that squares of distances neither overflow
      // nor vanish.
      const double* x = this->Particles.Points[i];
      std::transform(x, x + 3, this->Points.data() + 3 * i, [this](double coordinate) {
        return std::clamp(this->Scale.ToUnits(coordinate), -farOutside, farOutside);
      });
      Point<Dimension> index;
      if (!this->Grid.template NearestIndex<Dimension>(x, index.data()))
      {
        ++outside;
        this->Block.data()[i] = noBlock;
        return;
      }
      // Particles in cells without mass show an error of the transport.
      if (!this->Flow.HasMass(index))
      {
        ++inEmpty;
      }
      this->Block.data()[i] = this->Blocks.At(index);
    });
    this->Quality.Outside = sumOverRanks(this->Group, outside.load());
    this->Quality.InEmptyCells = sumOverRanks(this->Group, inEmpty.load());
  }

  // Sums up the particles' masses; without an array of masses each particle has the mass 1.
  void AddMasses(Progress& progress)
  {
    if (onAllRanks(this->Group, !this->Particles.Masses || this->Count == 0))
    {
      this->ParticleMass = static_cast<double>(this->Quality.Particles);
      return;
    }
    // Masses are relative to their sum, as only the distribution is compared.
    const double total =
      this->SumInOrder(progress, [this](std::int64_t i) { return this->Particles.Masses[i]; });
    if (!(total > 0.0) || std::isinf(total))
    {
      throw std::invalid_argument("The masses of the particles sum to " + std::to_string(total) +
        "; the sum must be positive and a double");
    }
    this->ParticleMass = total;
  }

  // Without displacements on any rank the cost stays 0.
  void MeasureCost(Progress& progress)
  {
    if (onAllRanks(this->Group, this->Particles.Displacements.size() == 0))
    {
      return;
    }
    // The mean squared displacement, weighted by mass.
    this->Quality.TransportCost = this->SumInOrder(progress, [this](std::int64_t i) {
      const double* d = this->Particles.Displacements[i];
      return this->Share(i) * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    });
  }

  // The share of a particle, and the block that it belongs to.
  struct BlockTerm
  {
    std::int64_t Block;
    double Share;
  };

  // Adds the shares of the particles to this rank's blocks, in the order of the particles.
  void AddShares(Progress& progress)
  {
    double* found = this->Found.data();
    std::fill_n(found, this->OwnBlocks.Count, 0.0);
    if (!this->Order)
    {
      this->InOrder(this->Count, progress, [&](std::int64_t i) {
        if (this->Block.data()[i] != noBlock)
        {
          found[this->Block.data()[i]] += this->Share(i);
        }
      });
      return;
    }
    // Terms of the first rank's part of the order precede those of the second.
    std::vector<std::vector<BlockTerm>> received(static_cast<std::size_t>(this->Group.Count()));
    {
      // Terms go to the ranks that own their blocks, without those of particles outside.
      std::vector<BlockTerm> terms = this->Order->Redistribute([this](std::int64_t i) {
        return BlockTerm{ this->Block.data()[i], this->Share(i) };
      });
      terms.erase(std::remove_if(terms.begin(), terms.end(),
                    [](const BlockTerm& term) { return term.Block == noBlock; }),
        terms.end());
      const auto termAt = [&terms](std::int64_t i) { return terms[static_cast<std::size_t>(i)]; };
      exchangeInRounds(
        this->Group, static_cast<std::int64_t>(terms.size()),
        [&](std::int64_t i) {
          return RankShare::Of(termAt(i).Block, this->NumberOfBlocks, this->Group.Count());
        },
        termAt, [&](std::size_t rank, const BlockTerm& term) { received[rank].push_back(term); });
    }
    for (const std::vector<BlockTerm>& terms : received)
    {
      for (const BlockTerm& term : terms)
      {
        found[term.Block - this->OwnBlocks.First] += term.Share;
      }
    }
  }

  // Computes the relative L2 distance of two densities that are constant on blocks: ||p - q|| /
  // ||q|| with the norm sum over blocks of share^2 / measure.
  void CompareBlocks(Progress& progress)
  {
    Stages stages(progress, { { "particles", 1 }, { "density", 1 }, { "errors", 1 } });
    this->AddShares(stages["particles"]);
    const double* found = this->Found.data();
    const double* expected = this->Expected.data();
    // The density's own share of the mass in each block, from its tables.
    findBlockShares<Dimension>(this->Flow, this->Blocks, this->OwnBlocks.First,
      this->OwnBlocks.Count, this->Expected.data(), stages["density"]);
    struct Squares
    {
      double Difference = 0.0;
      double Norm = 0.0;
      BlockCorrelation Blocks;
    };
    const Squares squares = sumInTurn(this->Group, Squares(), [&](Squares& sums) {
      this->InOrder(this->OwnBlocks.Count, stages["errors"], [&](std::int64_t i) {
        const double measure = this->Blocks.Box(this->OwnBlocks.First + i).Cells();
        // A share divided by the measure is a density; the square of it times the measure is its
        // part of the norm.
        const double off = found[i] - expected[i];
        sums.Difference += off * off / measure;
        sums.Norm += expected[i] * expected[i] / measure;
        sums.Blocks.Add(found[i], expected[i], measure);
      });
    });
    this->Quality.DensityError = std::sqrt(squares.Difference / squares.Norm);
    this->Quality.Correlation = squares.Blocks.Value();
    const double cells = numberOfCells<Dimension>(this->Grid.template Size<Dimension>());
    // Relative errors of the blocks of this rank, in their order.
    std::vector<double> errors;
    this->InOrder(this->OwnBlocks.Count, stages["errors"], [&](std::int64_t i) {
      const double measure = this->Blocks.Box(this->OwnBlocks.First + i).Cells() / cells;
      // A relative error means little in blocks with hardly any mass.
      if (expected[i] > leastOfMean * measure)
      {
        errors.push_back(std::abs(found[i] - expected[i]) / expected[i]);
      }
    });
    this->Quality.Blocks = largestErrors(std::move(errors), this->Group);
  }

  // Divides the distance to each nearest neighbour by the largest spacing at the local density; -1
  // where it is not defined.
  void RelateSpacings(Progress& progress)
  {
    Stages stages(progress, { { "shares", 3 }, { "measures", 25 }, { "spacings", 2 } });
    double* spacing = this->Spacing.data();
    // The points in scaled units are no longer needed; their memory holds indices.
    const PointSpan<Dimension> index(this->Points.data(), this->Count);
    LargeBuffer<double> measures(this->Count);
    double* measure = measures.data();
    stages["shares"].ForEach(this->Count, particleGrain, [=](std::int64_t i) {
      const double share = this->Share(i);
      // A spacing needs a particle inside the domain, with mass, that has a neighbour.
      const bool isDefined =
        this->Block.data()[i] != noBlock && share > 0.0 && !std::isinf(spacing[i]);
      spacing[i] = isDefined ? spacing[i] : -1.0;
      measure[i] = isDefined ? share : 0.0;
      this->Grid.template NearestIndex<Dimension>(this->Particles.Points[i], index[i]);
    });
    // The measure of the smallest box about a particle that holds its share is the share divided by
    // the local density.
    this->Flow.MeasuresOfShares(
      index, boxAspect<Dimension>(this->Grid), measure, measure, stages["measures"]);
    // The side of a cube with the measure of a cell: distances are physical, measures in cells.
    const double side = this->Scale.ToUnits(root<Dimension>(this->Grid.CellMeasure()));
    stages["spacings"].ForEach(this->Count, particleGrain, [=](std::int64_t i) {
      spacing[i] =
        spacing[i] < 0.0 ? spacing[i] : spacing[i] / (largestSpacing<Dimension>(measure[i]) * side);
    });
  }

  // The mean and the least of the relative spacings, over the particles of all ranks.
  void AverageSpacings(Progress& progress)
  {
    struct Spacings
    {
      double Sum = 0.0;
      double Smallest = std::numeric_limits<double>::infinity();
      std::int64_t Related = 0;
    };
    const std::vector<double> brought = this->Order
      ? this->Order->Redistribute([this](std::int64_t i) { return this->Spacing.data()[i]; })
      : std::vector<double>();
    const double* all = this->Order ? brought.data() : this->Spacing.data();
    const std::int64_t count = this->Order ? this->Order->Count() : this->Count;
    // Sum, minimum and number of the relative spacings, in the order of the particles.
    const Spacings found = sumInTurn(this->Group, Spacings(), [&](Spacings& sums) {
      this->InOrder(count, progress, [&](std::int64_t i) {
        if (all[i] >= 0.0)
        {
          sums.Sum += all[i];
          sums.Smallest = std::min(sums.Smallest, all[i]);
          ++sums.Related;
        }
      });
    });
    if (!std::isfinite(found.Sum))
    {
      throw std::overflow_error(
        "MeanSpacing passes the largest double; the spacings of the density along its axes must "
        "be more alike");
    }
    if (found.Related > 0)
    {
      this->Quality.SmallestSpacing = found.Smallest;
      this->Quality.MeanSpacing = found.Sum / static_cast<double>(found.Related);
    }
  }

  const ParticleSample& Particles;
  const RectifiedFlow<Dimension>& Flow;
  const ImageGrid& Grid;
  const LengthScale Scale;
  const GridBlocks<Dimension> Blocks;
  const std::int64_t NumberOfBlocks;
  const Ranks& Group;
  const RankShare OwnBlocks;
  const std::int64_t Count;
  LargeBuffer<double> Points; // in units of Scale
  LargeBuffer<std::int64_t> Block;
  LargeBuffer<double> Spacing;
  LargeBuffer<double> Found; // shares of the mass in each block
  LargeBuffer<double> Expected;
  double ParticleMass = 0.0;
  std::optional<RankOrder> Order; // order of the particles on several ranks
  ParticleQuality Quality;
};

} // namespace

// Cubes of physical space are boxes of these proportions in index space.
template <int Dimension>
Point<Dimension> boxAspect(const ImageGrid& grid)
{
  const LengthScale scale(grid);
  const GridSize<Dimension> size = grid.Size<Dimension>();
  Point<Dimension> aspect = grid.Lengths<Dimension>();
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // Cells for each unit of length along an axis.
    aspect[axis] = static_cast<double>(size[axis]) / scale.ToUnits(aspect[axis]);
  }
  return aspect;
}

template <int Dimension>
ParticleQuality measureQuality(const ParticleSample& particles,
  const RectifiedFlow<Dimension>& flow, const ImageGrid& grid, std::int64_t blockSize,
  const Context& context)
{
  if (blockSize < 1)
  {
    throw std::invalid_argument(
      "BlockSize is " + std::to_string(blockSize) + ", it must be at least 1");
  }
  Progress progress(context);
  return QualityRun<Dimension>(particles, flow, grid, blockSize, progress.Group())
    .Measure(progress);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(boxAspect);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(measureQuality);

} // namespace RectifiedTransport
