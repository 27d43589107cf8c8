// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/RectifiedFlow.h"

#include "Core/Flow/FlowArguments.h"
#include "Core/Flow/FlowEngine.h"
#include "Core/Flow/Steps/AutomaticSteps.h"
#include "Core/Flow/Tiles/TiledEngine.h"
#include "Core/Flow/WholeEngine.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/NearestMass.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace RectifiedTransport
{

// The numbers of steps that were chosen for a flow, kept for later runs.
class StepChoiceCache
{
public:
  // The choice if all ranks have it; else what make() returns, which is kept. Several runs
  // may call it concurrently. Collective.
  template <class Make>
  StepChoice FindOrMake(
    const FlowOptions& options, FlowDirection direction, const Ranks& ranks, const Make& make)
  {
    const double particles = direction == FlowDirection::Forward ? options.Particles : 0.0;
    const Key key(direction, options.Integrator, options.Lookup, options.Maps, options.LeastSteps,
      options.NeedsEstimate, options.AreaTolerance, particles);
    const std::optional<StepChoice> cached = this->Find(key);
    if (onAllRanks(ranks, cached.has_value()))
    {
      return *cached;
    }
    // Not locked: other runs make the same choice meanwhile.
    const StepChoice made = make();
    this->Insert(key, made);
    return made;
  }

private:
  using Key =
    std::tuple<FlowDirection, Integrator, TableLookup, FlowMaps, int, bool, double, double>;

  std::optional<StepChoice> Find(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = this->Choices.find(key);
    return found == this->Choices.end() ? std::optional<StepChoice>() : found->second;
  }

  void Insert(const Key& key, const StepChoice& choice)
  {
    constexpr std::size_t most = 64; // tolerances or particles that an animation goes through
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Choices.size() == most)
    {
      this->Choices.clear();
    }
    this->Choices[key] = choice;
  }

  std::mutex Mutex;
  std::map<Key, StepChoice> Choices;
};

namespace
{

// Tiles are blocks of 2D or 3D grids; lines are small enough for whole tables.
constexpr const char* noTiles = "a density of one axis has no tiles, it needs whole tables";

} // namespace

template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(
  const DensitySource<Dimension>& density, const Context& context)
  : RectifiedFlow(density, FlowTables::Whole, context)
{
}

// The tables of the density decide what the engine is: summed-area tables of the whole grid, or
// tables a tile at a time.
template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(const DensitySource<Dimension>& density, FlowTables tables,
  const Context& context, const TileLimits& limits)
  : Cells(density.Size)
  , Steps(std::make_unique<StepChoiceCache>())
{
  check<Dimension>(density.Size, "a density");
  Progress progress(context);
  if (tables == FlowTables::Whole)
  {
    this->Engine = std::make_unique<WholeEngine<Dimension>>(density, progress);
  }
  else if constexpr (Dimension == 1)
  {
    throw std::invalid_argument(noTiles);
  }
  else
  {
    this->Engine = std::make_unique<TiledEngine<Dimension>>(density, limits, progress);
  }
}

// A time series: the tables of the next density are made in the memory of the previous ones, which
// saves the time that the system takes to clear pages.
template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(
  const DensitySource<Dimension>& density, RectifiedFlow&& previous, const Context& context)
  : Cells(density.Size)
  , Steps(std::make_unique<StepChoiceCache>())
{
  check<Dimension>(density.Size, "a density");
  TableMemory memory;
  // The previous flow is empty afterwards.
  if (const std::unique_ptr<FlowEngine<Dimension>> engine = std::move(previous.Engine))
  {
    memory = engine->ReleaseMemory();
  }
  Progress progress(context);
  this->Engine = std::make_unique<WholeEngine<Dimension>>(density, progress, std::move(memory));
}

template <int Dimension>
RectifiedFlow<Dimension>::~RectifiedFlow() = default;

template <int Dimension>
RectifiedFlow<Dimension>::RectifiedFlow(RectifiedFlow&&) noexcept = default;

template <int Dimension>
RectifiedFlow<Dimension>& RectifiedFlow<Dimension>::operator=(RectifiedFlow&&) noexcept = default;

// The sum of the density's values over its cells; times the measure of a cell it is the mass.
template <int Dimension>
double RectifiedFlow<Dimension>::Total() const
{
  return this->Engine->Summary().Total;
}

template <int Dimension>
const DensitySummary& RectifiedFlow<Dimension>::Summary() const
{
  return this->Engine->Summary();
}

// M = the density's centroid, in cells: the straight start of all paths ends on the way to it.
template <int Dimension>
Point<Dimension> RectifiedFlow<Dimension>::Centroid() const
{
  Point<Dimension> centroid;
  std::copy_n(this->Engine->View().Centroid, Dimension, centroid.begin());
  return centroid;
}

template <int Dimension>
std::int64_t RectifiedFlow<Dimension>::MemorySize() const
{
  return this->Engine->MemorySize();
}

// One record of doubles for each node of each level. Each coarse level has 2^-(Dimension
// levelShift) of the nodes of the finer one, so that all levels together are a geometric series.
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

// An estimate of the bytes of a run by tiles, with its particles.
template <int Dimension>
double RectifiedFlow<Dimension>::TiledMemoryFor(const GridSize<Dimension>& size,
  const FlowOptions& options, FlowDirection direction, double particles, bool isLattice,
  const TileLimits& limits)
{
  if constexpr (Dimension == 1)
  {
    throw std::invalid_argument(noTiles);
  }
  else
  {
    return TiledEngine<Dimension>::MemoryFor(
      size, options, direction, particles, isLattice, limits);
  }
}

template <int Dimension>
double RectifiedFlow<Dimension>::TiledSharesMemoryFor(const GridSize<Dimension>& size,
  const Point<Dimension>& aspect, double boxes, const TileLimits& limits)
{
  if constexpr (Dimension == 1)
  {
    throw std::invalid_argument(noTiles);
  }
  else
  {
    return TiledEngine<Dimension>::MemoryForShares(size, aspect, boxes, limits);
  }
}

// Replaces the density that tiles are read from; whole tables hold it already.
template <int Dimension>
void RectifiedFlow<Dimension>::SetDensity(const DensitySource<Dimension>& density)
{
  this->Engine->SetDensity(density);
}

// Tells a tiled flow which boxes Share will be asked for, so that it sums their tiles once.
template <int Dimension>
void RectifiedFlow<Dimension>::PrepareShares(
  const GridSize<Dimension>& low, const GridSize<Dimension>& high) const
{
  this->Engine->PrepareShares(low, high);
}

// The bits of occupied cells decide, because rounding leaves differences of sums that are not 0.
template <int Dimension>
bool RectifiedFlow<Dimension>::HasMass(const Point<Dimension>& point) const
{
  return hasMass<Dimension>(this->Engine->View(), point);
}

// The share of the whole mass in the box [low, high]: differences of 2^Dimension entries of the
// interpolated table.
template <int Dimension>
double RectifiedFlow<Dimension>::Share(
  const Point<Dimension>& low, const Point<Dimension>& high) const
{
  return this->Engine->Share(low, high);
}

// The inverse of Share for boxes that grow about a centre with the given aspect: the share is
// monotone in the size, so false position and bisection find it (BoxShare.h).
template <int Dimension>
double RectifiedFlow<Dimension>::MeasureOfShare(
  const Point<Dimension>& centre, const Point<Dimension>& aspect, double share) const
{
  return this->Engine->MeasureOfShare(centre, aspect, share);
}

template <int Dimension>
void RectifiedFlow<Dimension>::MeasuresOfShares(ConstPointSpan<Dimension> centres,
  const Point<Dimension>& aspect, const double* shares, double* measures,
  const Context& context) const
{
  this->Engine->MeasuresOfShares(centres, aspect, shares, measures, context);
}

// NumberOfSteps 0: as many steps as AreaTolerance asks, found by probes of the flow
// (AutomaticSteps.h). A choice is kept for each set of options, and all ranks take the same one.
template <int Dimension>
StepChoice RectifiedFlow<Dimension>::ChooseSteps(
  const FlowOptions& options, FlowDirection direction, const Context& context) const
{
  check(options);
  return this->Steps->FindOrMake(options, direction, *context.Group,
    [&]() { return chooseSteps<Dimension>(*this->Engine, options, direction, context); });
}

// Calls run(options, context) with the steps that are asked for or chosen. Collective if steps are
// chosen: a rank without particles takes part, and nothing is chosen if no rank has any.
template <int Dimension>
template <class Run>
FlowReport RectifiedFlow<Dimension>::RunWithSteps(const FlowOptions& options,
  FlowDirection direction, double particles, const Context& context, const Run& run) const
{
  check(options);
  Progress progress(context);
  const bool choosesSteps = options.NumberOfSteps == 0;
  Stages stages(progress, { { "steps", choosesSteps ? 1.0 : 0.0 }, { "particles", 9 } });
  StepChoice choice;
  FlowOptions chosen = options;
  if (choosesSteps)
  {
    // All ranks decide alike, as choosing is collective.
    const bool hasParticles = !onAllRanks(*context.Group, particles == 0.0);
    choice = hasParticles ? this->ChooseSteps(options, direction, stages["steps"]) : choice;
    chosen = choice.Of(options);
  }
  FlowReport report = run(chosen, stages["particles"]);
  report.NumberOfSteps = stepsOf(chosen);
  report.Add(choice);
  return report;
}

// From the uniform measure at t = 0 to the density at t = 1: dx/dt = (m(x, t) - x) / (1 - t).
template <int Dimension>
FlowReport RectifiedFlow<Dimension>::Forward(const FlowSeeds<Dimension>& seeds,
  PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) const
{
  return this->RunWithSteps(options, FlowDirection::Forward, seeds.Count(), context,
    [&](const FlowOptions& chosen, const Context& stage) {
      return this->Engine->Advect(AdvectionKind::Forward, seeds, positions, chosen, stage);
    });
}

// The same equation from t = 1 to 0, density to uniform.
template <int Dimension>
FlowReport RectifiedFlow<Dimension>::Backward(const FlowSeeds<Dimension>& points,
  PointSpan<Dimension> positions, const FlowOptions& options, const Context& context) const
{
  return this->RunWithSteps(options, FlowDirection::Backward, points.Count(), context,
    [&](const FlowOptions& chosen, const Context& stage) {
      return this->Engine->Advect(AdvectionKind::Backward, points, positions, chosen, stage);
    });
}

// One run gives the positions at all times, by Hermite interpolation within steps.
template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardAt(const FlowSeeds<Dimension>& seeds,
  const std::vector<double>& times, PointSpan<Dimension> positions, const FlowOptions& options,
  const Context& context) const
{
  // A whole lattice, or an array, has a position for each seed and time; parts of lattices are
  // checked with their seeds.
  check(times);
  if (!seeds.IsLattice() || seeds.IsWholeLattice())
  {
    checkCount(positions.size(), seeds.Count() * static_cast<double>(times.size()));
  }
  return this->RunWithSteps(options, FlowDirection::Forward, seeds.Count(), context,
    [&](const FlowOptions& chosen, const Context& stage) {
      return this->Engine->AdvectAt(seeds, times, positions, chosen, stage);
    });
}

// Writes the cell of the target where each seed ends. No steps are chosen: 0 means the fewest, of
// which the first pass takes a multiple (firstRefinement).
template <int Dimension>
FlowReport RectifiedFlow<Dimension>::ForwardToCells(const FlowSeeds<Dimension>& seeds,
  std::int64_t* cells, const FlowOptions& options, const Context& context) const
{
  check(options);
  const FlowOptions chosen = options.NumberOfSteps == 0 ? StepChoice().Of(options) : options;
  FlowReport report = this->Engine->AdvectToCells(seeds, cells, chosen, context);
  report.NumberOfSteps = stepsOf(chosen) << firstRefinement(chosen, AdvectionKind::ForwardToCells);
  return report;
}

// The one-off function: the tables and their memory do not outlive it.
template <int Dimension>
std::vector<Point<Dimension>> transportPoints(const DensitySource<Dimension>& density,
  const FlowSeeds<Dimension>& seeds, const FlowOptions& options, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "tables", 1 }, { "particles", 9 } });
  // The tables are released when the points are there.
  const RectifiedFlow<Dimension> flow(density, stages["tables"]);
  std::vector<Point<Dimension>> positions(static_cast<std::size_t>(seeds.Count()));
  flow.Forward(seeds, positions, options, stages["particles"]);
  return positions;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(RectifiedFlow);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(transportPoints);

} // namespace RectifiedTransport
