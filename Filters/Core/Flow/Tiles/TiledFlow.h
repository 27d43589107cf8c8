// SPDX-License-Identifier: BSD-3-Clause
// The flow of a large density, whose tables of tiles are made anew in every advection.
#ifndef RectifiedTransport_TiledFlow_h
#define RectifiedTransport_TiledFlow_h

#include "Core/Flow/KeptFlowMap.h"
#include "Core/Flow/Tiles/TiledAdvection.h"
#include "Core/Flow/Tiles/TiledShares.h"
#include "Core/Tables/DensityShare.h"

#include <cstdint>
#include <memory>
#include <stdexcept>

namespace RectifiedTransport
{

template <int Dimension>
class TiledFlow
{
public:
  TiledFlow(const DensitySource<Dimension>& density, const TileLimits& limits, Progress& progress)
    : Size(density.Size)
    , Density(density)
    , Limits(limits)
    , Graded(density, gradedStrides<Dimension>(density.Size, limits), gradedRatio, progress)
  {
  }

  // Without levels.
  const TableView<Dimension>& View() const { return this->Graded.View(); }
  const DensitySummary& Summary() const { return this->Graded.Summary(); }
  std::int64_t MemorySize()
  {
    return this->Graded.MemorySize() + this->Maps[0].MemorySize() + this->Maps[1].MemorySize();
  }
  void SetDensity(const DensitySource<Dimension>& density) { this->Density = density; }
  void PrepareShares(const GridSize<Dimension>& low, const GridSize<Dimension>& high)
  {
    this->Prepared = this->Density.Part(low, high);
  }
  static double MemoryFor(const GridSize<Dimension>& size, const FlowOptions& options,
    FlowDirection direction, double particles, bool isLattice, const TileLimits& limits)
  {
    requireTiles<Dimension>(size, options, direction, limits);
    return PlanFor(size, options, direction, particles, limits).MemorySize(particles, isLattice);
  }
  static double MemoryForShares(const GridSize<Dimension>& size, const Point<Dimension>& aspect,
    double boxes, const TileLimits& limits)
  {
    return gradedMemory<Dimension>(size, gradedStrides<Dimension>(size, limits)) +
      TiledShares<Dimension>::MemoryFor(tilesForShares<Dimension>(size, aspect, limits), boxes);
  }
  double Share(const Point<Dimension>& low, const Point<Dimension>& high) const
  {
    const std::shared_ptr<const DensityValues> values =
      this->Density.IsDistributed() ? this->Prepared : this->Density.Whole();
    return densityIn<Dimension>({ this->Size, *values }, low, high) / this->Summary().Total;
  }

  void MeasuresOfShares(ConstPointSpan<Dimension> centres, const Point<Dimension>& aspect,
    const double* shares, double* measures, Progress& progress)
  {
    const GridTiles<Dimension> tiles = tilesForShares<Dimension>(this->Size, aspect, this->Limits);
    TiledShares<Dimension>(this->Density, this->Graded, tiles, aspect, progress)
      .Run(centres, shares, measures);
  }

  // Throws std::invalid_argument where tiles do not serve the options, NoMemoryForFlowMap,
  // std::bad_alloc and Cancelled.
  template <class Source>
  FlowReport Advect(AdvectionKind kind, Source&& source, PointSpan<Dimension> positions,
    const FlowOptions& options, const Context& context)
  {
    const AdvectionJob<Dimension> shared(this->View(), kind, options);
    const bool isBackward = kind == AdvectionKind::Backward;
    const FlowDirection direction = isBackward ? FlowDirection::Backward : FlowDirection::Forward;
    requireTiles<Dimension>(this->Size, options, direction, this->Limits);
    const double particles = source.CountOfAll(*context.Group);
    const TilePlan<Dimension> plan =
      PlanFor(this->Size, options, direction, particles, this->Limits);
    Counters counters;
    Progress progress(context);
    std::shared_ptr<const FlowMap<Dimension>> map;
    if (!plan.Shape.Levels.empty())
    {
      bool isNew = false;
      map = this->Maps[isBackward ? 1 : 0].FindOrMake(
        plan.Shape, 0, shared.Job, *context.Group,
        [&]() {
          progress.BeginStage(plan.Shape.Cost / (plan.Shape.Cost + particles * plan.HandOver));
          return progress.Stage();
        },
        isNew);
      counters.Evaluations += isNew ? map->Evaluations() : 0;
    }
    TiledAdvection<Dimension>(
      this->Density, this->Graded, plan, shared, map.get(), counters, progress)
      .Run(source, positions);
    FlowReport report;
    report.Redone = counters.Redone;
    report.MovedToMass = counters.MovedToMass;
    report.Evaluations = counters.Evaluations;
    return report;
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
  KeptFlowMap<Dimension> Maps[2];
};

// Densities of one axis are not cut in tiles.
template <>
class TiledFlow<1>
{
public:
  TiledFlow(const DensitySource<1>&, const TileLimits&, Progress&)
  {
    throw std::invalid_argument("a density of one axis has no tiles, it needs whole tables");
  }
  const TableView<1>& View() const { return this->Tables; }
  const DensitySummary& Summary() const { return this->Found; }
  std::int64_t MemorySize() { return 0; }
  void SetDensity(const DensitySource<1>&) {}
  void PrepareShares(const GridSize<1>&, const GridSize<1>&) {}
  static double MemoryFor(
    const GridSize<1>&, const FlowOptions&, FlowDirection, double, bool, const TileLimits&)
  {
    throw std::invalid_argument("a density of one axis has no tiles, it needs whole tables");
  }
  static double MemoryForShares(const GridSize<1>&, const Point<1>&, double, const TileLimits&)
  {
    throw std::invalid_argument("a density of one axis has no tiles, it needs whole tables");
  }
  void MeasuresOfShares(ConstPointSpan<1>, const Point<1>&, const double*, double*, const Progress&)
  {
  }
  double Share(const Point<1>&, const Point<1>&) const { return 0.0; }
  template <class Source>
  FlowReport Advect(AdvectionKind, Source&&, PointSpan<1>, const FlowOptions&, const Context&)
  {
    return {};
  }

private:
  TableView<1> Tables{};
  DensitySummary Found;
};

} // namespace RectifiedTransport

#endif
