// SPDX-License-Identifier: BSD-3-Clause
// A flow of a large density, whose tables of tiles are made anew in every advection.
#ifndef RectifiedTransport_TiledEngine_h
#define RectifiedTransport_TiledEngine_h

#include "Core/Flow/FlowEngine.h"
#include "Core/Flow/FlowMapCache.h"
#include "Core/Flow/Particles/ParticleSource.h"
#include "Core/Flow/Tiles/TiledAdvection.h"
#include "Core/Flow/Tiles/TiledShares.h"
#include "Core/Tables/DensityShare.h"

#include <algorithm>
#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

// For two or three axes: densities of one are not cut in tiles.
template <int Dimension>
class TiledEngine final : public FlowEngine<Dimension>
{
public:
  TiledEngine(const DensitySource<Dimension>& density, const TileLimits& limits, Progress& progress)
    : Size(density.Size)
    , Density(density)
    , Limits(limits)
    , Graded(density, gradedStrides<Dimension>(density.Size, limits), gradedRatio, progress)
  {
  }

  const TableView<Dimension>& View() const override { return this->Graded.View(); }
  const DensitySummary& Summary() const override { return this->Graded.Summary(); }
  bool HasWholeTables() const override { return false; }
  std::int64_t MemorySize() override { return this->Graded.MemorySize() + this->Maps.MemorySize(); }
  void SetDensity(const DensitySource<Dimension>& density) override { this->Density = density; }
  void PrepareShares(const GridSize<Dimension>& low, const GridSize<Dimension>& high) override
  {
    // For a distributed density the part is gathered once for many boxes.
    this->Prepared = this->Density.Part(low, high);
  }
  static double MemoryFor(const GridSize<Dimension>& size, const FlowOptions& options,
    FlowDirection direction, double particles, bool isLattice, const TileLimits& limits)
  {
    requireTiles<Dimension>(size, options, direction, limits);
    FlowOptions fixed = options;
    double most = 0.0;
    // What NumberOfSteps 0 may mean.
    constexpr int usual = 512;
    int last = options.NumberOfSteps;
    if (options.NumberOfSteps == 0)
    {
      fixed = StepChoice().Of(options);
      last = std::max(usual, fixed.NumberOfSteps);
    }
    for (; fixed.NumberOfSteps <= last; fixed.NumberOfSteps *= 2)
    {
      // The most memory of any of these numbers of steps: a plan's hand-over depends on them.
      most = std::max(
        most, PlanFor(size, fixed, direction, particles, limits).MemorySize(particles, isLattice));
    }
    return most;
  }
  static double MemoryForShares(const GridSize<Dimension>& size, const Point<Dimension>& aspect,
    double boxes, const TileLimits& limits)
  {
    return gradedMemory<Dimension>(size, gradedStrides<Dimension>(size, limits)) +
      TiledShares<Dimension>::MemoryFor(tilesForShares<Dimension>(size, aspect, limits), boxes);
  }
  double Share(const Point<Dimension>& low, const Point<Dimension>& high) const override
  {
    const std::shared_ptr<const DensityValues> values =
      this->Density.IsDistributed() ? this->Prepared : this->Density.Whole();
    // Sums the values of the cells in the box, as there is no whole table.
    return densityIn<Dimension>({ this->Size, *values }, low, high) / this->Summary().Total;
  }

  void MeasuresOfShares(ConstPointSpan<Dimension> centres, const Point<Dimension>& aspect,
    const double* shares, double* measures, const Context& context) override
  {
    Progress progress(context);
    const GridTiles<Dimension> tiles = tilesForShares<Dimension>(this->Size, aspect, this->Limits);
    TiledShares<Dimension>(this->Density, this->Graded, tiles, aspect, progress)
      .Run(centres, shares, measures);
  }

  // In chunks, each of which goes through all tiles. Throws std::invalid_argument also where tiles
  // do not serve the options.
  FlowReport Advect(AdvectionKind kind, const FlowSeeds<Dimension>& seeds,
    PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) override
  {
    // Particles are sorted by chunks, which bounds their memory.
    ParticleSource<Dimension> source(
      seeds, this->Size, positions.size(), TilePlan<Dimension>::SortedParticles);
    const AdvectionJob<Dimension> shared(this->View(), kind, options);
    const FlowDirection direction = directionOf(kind);
    requireTiles<Dimension>(this->Size, options, direction, this->Limits);
    const double particles = source.CountOfAll(*context.Group);
    const TilePlan<Dimension> plan =
      PlanFor(this->Size, options, direction, particles, this->Limits);
    Counters counters;
    Progress progress(context);
    Stages stages(
      progress, { { "map", plan.Shape.Cost }, { "particles", particles * plan.HandOver } });
    std::shared_ptr<const FlowMap<Dimension>> map;
    if (!plan.Shape.Levels.empty())
    {
      map = this->Maps.FindOrMake(plan.Shape, 0, *context.Group, [&]() {
        auto made =
          std::make_shared<const FlowMap<Dimension>>(plan.Shape, shared.Job, stages["map"]);
        counters.Evaluations += made->Evaluations();
        return made;
      });
    }
    TiledAdvection<Dimension>(
      this->Density, this->Graded, plan, shared, map.get(), counters, stages["particles"])
      .Run(source, positions);
    return counters.Report();
  }

private:
  static TilePlan<Dimension> PlanFor(const GridSize<Dimension>& size, const FlowOptions& options,
    FlowDirection direction, double particles, const TileLimits& limits)
  {
    TilePlan<Dimension> plan(size, options.NumberOfSteps, direction, true, limits);
    // Without maps particles go to the hand-over like nodes: in twice the steps, far apart.
    constexpr double costWithout = 3.0;
    const bool hasMaps = particles > 0.0 && options.Maps != FlowMaps::Off &&
      (options.Maps == FlowMaps::On || plan.Shape.PaysFor(costWithout * particles));
    return hasMaps ? plan
                   : TilePlan<Dimension>(size, options.NumberOfSteps, direction, false, limits);
  }

  const GridSize<Dimension> Size;
  DensitySource<Dimension> Density;
  std::shared_ptr<const DensityValues> Prepared; // for Share
  const TileLimits Limits;
  const GradedTables<Dimension> Graded;
  FlowMapCache<Dimension> Maps;
};

} // namespace RectifiedTransport

#endif
