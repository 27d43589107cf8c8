// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/RectifiedFlow.h"

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/FlowArguments.h"
#include "Core/Flow/KeptFlowMap.h"
#include "Core/Flow/LatticeOrder.h"
#include "Core/Flow/SortedPoints.h"
#include "Core/Flow/Tiles/TiledFlow.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Tables/BoxShare.h"
#include "Core/Tables/NearestMass.h"
#include "Core/Tables/SummedAreaTables.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

template <int Dimension>
SummedAreaTables<Dimension> build(
  const DensitySource<Dimension>& density, const Context& context, TableMemory memory)
{
  check<Dimension>(density.Size, "a density");
  Progress progress(context);
  return SummedAreaTables<Dimension>(density, progress, std::move(memory));
}

} // namespace

template <int Dimension>
struct RectifiedFlow<Dimension>::Internals
{
  Internals(
    const DensitySource<Dimension>& density, const Context& context, TableMemory memory = {})
    : Size(density.Size)
    , Tables(build(density, context, std::move(memory)))
  {
  }

  Internals(
    const DensitySource<Dimension>& density, const Context& context, const TileLimits& limits)
    : Size(density.Size)
  {
    check<Dimension>(density.Size, "a density");
    Progress progress(context);
    this->Tiles = std::make_unique<TiledFlow<Dimension>>(density, limits, progress);
  }

  // Without levels where there are tiles.
  const TableView<Dimension>& View() const
  {
    return this->Tiles ? this->Tiles->View() : this->Tables->View();
  }

  const DensitySummary& Summary() const
  {
    return this->Tiles ? this->Tiles->Summary() : this->Tables->Summary();
  }

  const TableView<Dimension>& WholeTables(const char* what) const
  {
    if (this->Tiles)
    {
      throw std::invalid_argument(std::string(what) + " needs whole tables, the flow has tiles");
    }
    return this->Tables->View();
  }

  template <class Source>
  FlowReport Advect(AdvectionKind kind, Source&& source, PointSpan<Dimension> positions,
    const FlowOptions& options, const Context& context)
  {
    if (this->Tiles)
    {
      return this->Tiles->Advect(kind, source, positions, options, context);
    }
    AdvectionRun<Dimension> run(this->Tables->View(), kind, options, context);
    this->Prepare(run, options, source.CountOfAll(*context.Group));
    return run.Advect(source, positions);
  }

  // In chunks, each of which goes through all tiles.
  SortedPoints<Dimension> Sorted(ConstPointSpan<Dimension> points) const
  {
    return SortedPoints<Dimension>(points,
      this->Tiles ? TilePlan<Dimension>::SortedParticles : SortedPoints<Dimension>::UsualChunk);
  }

  // Gives a run of so many particles, whose positions are wanted from `firstTime` on, the flow map
  // that its options ask for, if any.
  void Prepare(AdvectionRun<Dimension>& run, const FlowOptions& options, double particles,
    double firstTime = 1.0)
  {
    const AdvectionJob<Dimension>& shared = run.SharedJob();
    const FlowJob<Dimension>& job = shared.Job;
    if (!takesFlowMaps(options) || options.Maps == FlowMaps::Off || particles == 0.0)
    {
      return;
    }
    const FlowMapShape<Dimension> shape(this->Size, options.NumberOfSteps,
      job.Backward ? FlowDirection::Backward : FlowDirection::Forward, shared.Refinement);
    // Isolated cells leave most boxes empty before particles could take over.
    const bool pays = shared.Kind != AdvectionKind::ForwardToCells && shape.PaysFor(particles);
    if (shape.Levels.empty() || firstTime < 1.0 - shape.Levels.back().TimeLeft ||
      (options.Maps == FlowMaps::Auto && !pays))
    {
      return;
    }
    const double particlesCost = particles * shape.Levels.back().HandOver;
    KeptFlowMap<Dimension>& kept = this->Maps[job.Backward ? 1 : 0];
    bool isNew = false;
    auto map = kept.FindOrMake(
      shape, shared.Refinement, job, run.Group(),
      [&]() { return run.BeginPreparation(shape.Cost / (shape.Cost + particlesCost)); }, isNew);
    run.UseMap(std::move(map), isNew);
  }

  std::int64_t MemorySize()
  {
    return this->Tiles
      ? this->Tiles->MemorySize()
      : this->Tables->MemorySize() + this->Maps[0].MemorySize() + this->Maps[1].MemorySize();
  }

  GridSize<Dimension> Size;
  std::optional<SummedAreaTables<Dimension>> Tables;
  std::unique_ptr<TiledFlow<Dimension>> Tiles; // in place of Tables
  KeptFlowMap<Dimension> Maps[2];
};

template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(
  const DensitySource<Dimension>& density, const Context& context)
  : Data(std::make_unique<Internals>(density, context))
{
}

template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(const DensitySource<Dimension>& density, FlowTables tables,
  const Context& context, const TileLimits& limits)
  : Data(tables == FlowTables::Tiled ? std::make_unique<Internals>(density, context, limits)
                                     : std::make_unique<Internals>(density, context))
{
}

template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(
  const DensitySource<Dimension>& density, RectifiedFlow&& previous, const Context& context)
{
  TableMemory memory;
  if (const std::unique_ptr<Internals> data = std::move(previous.Data))
  {
    memory = data->Tables ? data->Tables->ReleaseMemory() : TableMemory();
  }
  this->Data = std::make_unique<Internals>(density, context, std::move(memory));
}

template <int Dimension>
RectifiedFlow<Dimension>::~RectifiedFlow() = default;

template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(RectifiedFlow&&) noexcept = default;

template <int Dimension>
RectifiedFlow<Dimension>& RectifiedFlow<Dimension>::operator=(RectifiedFlow&&) noexcept = default;

template <int Dimension>
const GridSize<Dimension>& RectifiedFlow<Dimension>::Size() const
{
  return this->Data->Size;
}

template <int Dimension>
double RectifiedFlow<Dimension>::Total() const
{
  return this->Data->Summary().Total;
}

template <int Dimension>
const DensitySummary& RectifiedFlow<Dimension>::Summary() const
{
  return this->Data->Summary();
}

template <int Dimension>
Point<Dimension> RectifiedFlow<Dimension>::Centroid() const
{
  Point<Dimension> centroid;
  std::copy_n(this->Data->View().Centroid, Dimension, centroid.begin());
  return centroid;
}

template <int Dimension>
std::int64_t RectifiedFlow<Dimension>::MemorySize() const
{
  return this->Data->MemorySize();
}

// One record for each node of each level, where a level has a fixed share of the nodes of the finer
// one.
template <int Dimension>
double RectifiedFlow<Dimension>::MemoryFor(const GridSize<Dimension>& size)
{
  double nodes = 1.0;
  for (const std::int64_t cells : size)
  {
    nodes *= static_cast<double>(cells + 1);
  }
  constexpr double levels = 1.0 / (1.0 - 1.0 / (1 << (Dimension * levelShift)));
  return nodes * levels * TableView<Dimension>::Record * sizeof(double);
}

template <int Dimension>
double RectifiedFlow<Dimension>::TiledMemoryFor(const GridSize<Dimension>& size,
  const FlowOptions& options, FlowDirection direction, double particles, bool isLattice,
  const TileLimits& limits)
{
  return TiledFlow<Dimension>::MemoryFor(size, options, direction, particles, isLattice, limits);
}

template <int Dimension>
double RectifiedFlow<Dimension>::TiledSharesMemoryFor(const GridSize<Dimension>& size,
  const Point<Dimension>& aspect, double boxes, const TileLimits& limits)
{
  return TiledFlow<Dimension>::MemoryForShares(size, aspect, boxes, limits);
}

template <int Dimension>
void RectifiedFlow<Dimension>::SetDensity(const DensitySource<Dimension>& density)
{
  if (this->Data->Tiles)
  {
    this->Data->Tiles->SetDensity(density);
  }
}

template <int Dimension>
void RectifiedFlow<Dimension>::PrepareShares(
  const GridSize<Dimension>& low, const GridSize<Dimension>& high) const
{
  if (this->Data->Tiles)
  {
    this->Data->Tiles->PrepareShares(low, high);
  }
}

template <int Dimension>
bool RectifiedFlow<Dimension>::HasMass(const Point<Dimension>& point) const
{
  return hasMass<Dimension>(this->Data->View(), point);
}

template <int Dimension>
double RectifiedFlow<Dimension>::Share(
  const Point<Dimension>& low, const Point<Dimension>& high) const
{
  return this->Data->Tiles ? this->Data->Tiles->Share(low, high)
                           : boxShare<Dimension>(this->Data->View(), low, high);
}

template <int Dimension>
double RectifiedFlow<Dimension>::MeasureOfShare(
  const Point<Dimension>& centre, const Point<Dimension>& aspect, double share) const
{
  return measureOfShare<Dimension>(
    this->Data->WholeTables("MeasureOfShare"), centre, aspect, share);
}

template <int Dimension>
void RectifiedFlow<Dimension>::MeasuresOfShares(ConstPointSpan<Dimension> centres,
  const Point<Dimension>& aspect, const double* shares, double* measures,
  const Context& context) const
{
  Progress progress(context);
  if (this->Data->Tiles)
  {
    this->Data->Tiles->MeasuresOfShares(centres, aspect, shares, measures, progress);
    return;
  }
  constexpr std::int64_t grain = 256;
  progress.BeginStage(1.0);
  progress.For(
    centres.size(), grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        Point<Dimension> centre;
        std::copy_n(centres[i], Dimension, centre.begin());
        measures[i] = measureOfShare<Dimension>(this->Data->View(), centre, aspect, shares[i]);
      }
    },
    16 * grain);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::Forward(ConstPointSpan<Dimension> seeds,
  PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) const
{
  checkCount(positions.size(), static_cast<double>(seeds.size()));
  return this->Data->Advect(
    AdvectionKind::Forward, this->Data->Sorted(seeds), positions, options, context);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardAt(ConstPointSpan<Dimension> seeds,
  const std::vector<double>& times, PointSpan<Dimension> positions, const FlowOptions& options,
  const Context& context) const
{
  check(times);
  checkCount(
    positions.size(), static_cast<double>(seeds.size()) * static_cast<double>(times.size()));
  AdvectionRun<Dimension> run(
    this->Data->WholeTables("a path"), AdvectionKind::Forward, options, context);
  SortedPoints<Dimension> source(seeds);
  this->Data->Prepare(run, options, source.CountOfAll(*context.Group), times.front());
  return run.Advect(source, positions, times);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::Backward(ConstPointSpan<Dimension> points,
  PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) const
{
  checkCount(positions.size(), static_cast<double>(points.size()));
  return this->Data->Advect(
    AdvectionKind::Backward, this->Data->Sorted(points), positions, options, context);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardLattice(const GridSize<Dimension>& lattice,
  PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) const
{
  return this->ForwardLattice(lattice, cellCentre<Dimension>(), positions, options, context);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardLattice(const GridSize<Dimension>& lattice,
  const Point<Dimension>& place, PointSpan<Dimension> positions, const FlowOptions& options,
  const Context& context) const
{
  checkCount(positions.size(), numberOfCells<Dimension>(lattice));
  return this->ForwardLattice(
    lattice, LatticeParts<Dimension>::WholeOf(lattice), place, positions, options, context);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardLattice(const GridSize<Dimension>& lattice,
  const LatticeParts<Dimension>& parts, const Point<Dimension>& place,
  PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) const
{
  const auto order = checkedOrder<Dimension>(lattice, parts, place, this->Size(), positions.size());
  return this->Data->Advect(AdvectionKind::Forward, order, positions, options, context);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::BackwardLattice(const GridSize<Dimension>& lattice,
  PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) const
{
  checkCount(positions.size(), numberOfCells<Dimension>(lattice));
  return this->BackwardLattice(
    lattice, LatticeParts<Dimension>::WholeOf(lattice), positions, options, context);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::BackwardLattice(const GridSize<Dimension>& lattice,
  const LatticeParts<Dimension>& parts, PointSpan<Dimension> positions, const FlowOptions& options,
  const Context& context) const
{
  const auto order = checkedOrder<Dimension>(
    lattice, parts, cellCentre<Dimension>(), this->Size(), positions.size());
  return this->Data->Advect(AdvectionKind::Backward, order, positions, options, context);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardLatticeToCells(const GridSize<Dimension>& lattice,
  std::int64_t* cells, const FlowOptions& options, const Context& context) const
{
  check<Dimension>(lattice, "a lattice");
  const LatticeOrder<Dimension> order(lattice, this->Data->Size);
  AdvectionRun<Dimension> run(
    this->Data->WholeTables("a run to cells"), AdvectionKind::ForwardToCells, options, context);
  this->Data->Prepare(run, options, static_cast<double>(order.Count()));
  return run.AdvectToCells(order, cells);
}

template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardToCells(ConstPointSpan<Dimension> seeds,
  std::int64_t* cells, const FlowOptions& options, const Context& context) const
{
  AdvectionRun<Dimension> run(
    this->Data->WholeTables("a run to cells"), AdvectionKind::ForwardToCells, options, context);
  this->Data->Prepare(run, options, static_cast<double>(seeds.size()));
  return run.AdvectToCells(SortedPoints<Dimension>(seeds), cells);
}

template <int Dimension>
std::vector<Point<Dimension>> transportPoints(const DensitySource<Dimension>& density,
  ConstPointSpan<Dimension> seeds, const FlowOptions& options, const Context& context)
{
  Progress progress(context);
  progress.BeginStage(0.1);
  const RectifiedFlow<Dimension> flow(density, progress.Stage());
  std::vector<Point<Dimension>> positions(static_cast<std::size_t>(seeds.size()));
  progress.BeginStage(1.0);
  flow.Forward(seeds, positions, options, progress.Stage());
  return positions;
}

template class RectifiedFlow<1>;
template class RectifiedFlow<2>;
template class RectifiedFlow<3>;
template std::vector<Point<1>> transportPoints<1>(
  const DensitySource<1>&, ConstPointSpan<1>, const FlowOptions&, const Context&);
template std::vector<Point<2>> transportPoints<2>(
  const DensitySource<2>&, ConstPointSpan<2>, const FlowOptions&, const Context&);
template std::vector<Point<3>> transportPoints<3>(
  const DensitySource<3>&, ConstPointSpan<3>, const FlowOptions&, const Context&);

} // namespace RectifiedTransport
