// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Plan/FlowCache.h"

#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// The peak of the solution of an optimal map from the uniform measure, a density on the same grid.
template <int D>
MemoryPlan memoryOfMap(const InputDensity& density, const OptimalNeeds& needs, const Ranks& ranks)
{
  const GridSize<D> size = density.Grid().Size<D>();
  return memoryOfOptimalMap<D>(
    "of a density of " + describeSize<D>(size) + " cells", size, size, needs, ranks);
}

// What an optimal map depends on besides the values of the density, which may be those of boxes of
// different sides.
template <int D>
void addSetting(const OptimalSetting& setting, const PlanEnd<D>& end, DataIdentity& identity)
{
  // IsOptimal does not count: from the uniform measure, the same solution serves Method Optimal and
  // Certify.
  identity.AddNumbers(&setting.Tolerance, 1);
  identity.AddNumbers(end.High.data(), D);
}

} // namespace

// The mass is the sum of the values times the measure of a cell. A density without mass, or with an
// infinite one, has no flow.
template <int D>
SharedFlow::SharedFlow(RectifiedFlow<D> flow, FlowTables tables, const InputDensity& density)
  : Flows(std::move(flow))
  , Kind(tables)
  , Mass(this->Flow<D>().Total() * density.Grid().CellMeasure())
{
  if (!(this->Mass > 0.0) || std::isinf(this->Mass))
  {
    DensitySummary found;
    found.Total = this->Mass;
    density.ThrowInvalid(found);
  }
  this->Values = density.Suspect();
  this->Values.Found = this->Flow<D>().Summary();
  this->Built.Modified();
}

template <int D>
std::shared_ptr<SharedFlow> SharedFlow::Make(InputDensity& density, FlowTables tables,
  std::shared_ptr<SharedFlow> previous, Progress& progress)
{
  // Old and new tables side by side would double the peak.
  std::optional<RectifiedFlow<D>> old;
  if (previous && tables == FlowTables::Whole && previous->HasFlow<D>())
  {
    old = std::move(*std::get_if<RectifiedFlow<D>>(&previous->Flows));
  }
  previous.reset();
  Stages stages(progress, { { "reading", 1 }, { "tables", 9 } });
  density.Prepare(tables, stages["reading"]);
  std::shared_ptr<SharedFlow> made;
  try
  {
    made = std::make_shared<SharedFlow>(old
        ? RectifiedFlow<D>(density.Source<D>(), std::move(*old), stages["tables"])
        : RectifiedFlow<D>(density.Source<D>(), tables, stages["tables"]),
      tables, density);
  }
  catch (const InvalidDensity& invalid)
  {
    density.ThrowInvalid(invalid.Summary());
  }
  catch (const std::bad_alloc& caught)
  {
    const GridSize<D> size = density.Grid().Size<D>();
    failOutOfMemory(caught,
      { "the tables of a density of " + describeSize<D>(size) + " cells",
        RectifiedFlow<D>::MemoryFor(size) });
  }
  density.ReleaseGathered(); // whole tables need no values
  return made;
}

void SharedFlow::Attach(InputDensity& density, Progress& progress)
{
  if (this->Kind == FlowTables::Tiled)
  {
    density.Prepare(this->Kind, progress);
    const auto set = [&](auto dimension) {
      constexpr int D = decltype(dimension)::value;
      if (auto* flow = std::get_if<RectifiedFlow<D>>(&this->Flows))
      {
        flow->SetDensity(density.Source<D>());
      }
    };
    set(std::integral_constant<int, 2>());
    set(std::integral_constant<int, 3>());
  }
}

const SharedFlow& FlowCache::Update(
  InputDensity& density, Progress& progress, FlowTables tables, const OptimalNeeds& needs)
{
  // Nobody else may own what is kept here while other tables take its memory.
  // Tables of the other kind cannot give their memory to the new ones.
  if (!this->Tables.IsEmpty() && this->Tables.Cached<SharedFlow>()->Tables() != tables)
  {
    this->Release();
  }
  // Modification times decide locally whether something must be read; one rank in need takes all
  // along, because hashing and building are collective.
  const bool isKnown = onAllRanks(progress.Group(), !this->IsOutdated(density));
  Stages stages(progress, { { "hash", isKnown ? 0.0 : 5.0 }, { "tables", 95 } });
  // Called only if no filter of the process has the tables of these values. `previous` gives its
  // memory to the new tables: two sets of tables side by side would double the peak.
  const auto make = [&](std::shared_ptr<SharedFlow> previous) {
    const auto build = dispatchDimension(
      density.Grid().Dimension(), &FlowCache::Build<1>, &FlowCache::Build<2>, &FlowCache::Build<3>);
    return (this->*build)(density, tables, needs, std::move(previous), stages["tables"]);
  };
  // Flows with tiles are not shared because they read the density of one filter's run.
  const auto flow = this->Tables.Get<SharedFlow>(density.Identity(), progress.Group(),
    stages["hash"], tables == FlowTables::Whole ? Sharing::Process : Sharing::None, make);
  // A flow that another filter has made may be older than the last one here: time never goes back.
  this->Time = std::max(this->Time, flow->BuildTime());
  flow->Attach(density, stages["tables"]);
  // Suspect values, such as fill values, are reported when they are new to this filter, even where
  // another filter has built the tables.
  if (!isKnown)
  {
    density.ReportSuspect(flow->Suspect(), stages["tables"]);
  }
  return *flow;
}

template <int D>
std::shared_ptr<SharedFlow> FlowCache::Build(InputDensity& density, FlowTables tables,
  const OptimalNeeds& needs, std::shared_ptr<SharedFlow> previous, Progress& progress)
{
  // Maps and corrections belong to the old tables, and their memory is needed for the new ones.
  this->ClearMaps();
  if (needs.Setting.NeedsMap())
  {
    // With the map's memory the tables' is asked for, unless those before leave theirs.
    const bool hasMemory = previous && previous->HasFlow<D>();
    const double bytes = RectifiedFlow<D>::MemoryFor(density.Grid().Size<D>());
    requireMemory(memoryOfMap<D>(density, needs, progress.Group()).With(hasMemory ? 0.0 : bytes));
  }
  return SharedFlow::Make<D>(density, tables, std::move(previous), progress);
}

template <int D>
TransportPlan<D> FlowCache::Plan(
  const OptimalNeeds& needs, const FlowOptions& options, InputDensity& density, Progress& progress)
{
  const OptimalSetting& setting = needs.Setting;
  // The plan begins at the uniform measure, so that it has one end: the density on its own grid.
  PlanEnd<D> end = planEnd<D>(PlanEnd<D>::On(density.Grid()), density);
  end.Flow = this->Flow<D>();
  const PlanOptions chosen = planOptions(setting, options);
  Stages stages(progress, { { "map", 8 }, { "check", 2 } });
  typename TransportPlan<D>::Map map;
  if (setting.NeedsMap())
  {
    DataIdentity identity = this->Identity();
    addSetting<D>(setting, end, identity);
    // The solver's memory lives only during this call; the solved map stays in the slot.
    const auto solve = [&]() {
      return withRequiredMemory(memoryOfMap<D>(density, needs, progress.Group()),
        [&]() { return TransportPlan<D>::Solve(nullptr, end, chosen.Optimal, stages["map"]); });
    };
    map = this->Map.Get<typename TransportPlan<D>::Map::element_type>(
      identity, progress.Group(), stages["map"], Sharing::Process, solve);
  }
  else
  {
    this->Map.Release();
  }
  // Exact counts of samples take memory besides the map's; it is checked when the map's solution
  // has returned its own.
  needs.RequireForSamples<D>(end.Size, progress.Group());
  return withMemory({ std::string("the optimal map (") + setting.Advice() + ")",
                      TransportPlan<D>::MemoryFor(end.Size, end.Size) },
    [&]() { return TransportPlan<D>(end, chosen, stages["check"], map); });
}

template <int D>
std::shared_ptr<const AreaCorrection<D>> FlowCache::Correction(const TransportPlan<D>& plan,
  const OptimalSetting& setting, const FlowOptions& options, Progress& progress)
{
  // The correction of a flow removes errors of its integration, so that all options count. That of
  // an optimal map depends on the tolerance and the lengths of the box alone.
  const auto flow = this->Flow<D>();
  DataIdentity identity = this->Identity();
  FlowOptions resolved;
  if (plan.IsOptimal())
  {
    addSetting<D>(setting, plan.Target(), identity);
  }
  else
  {
    resolved = AreaCorrection<D>::Resolve(*flow, options, progress);
    identity.AddOptions(resolved);
  }
  const auto make = [&]() {
    const MemoryPlan memory{ "the areas of " + describeSize<D>(flow->Size()) +
        " cells (EqualizeAreas Off needs none)",
      AreaCorrection<D>::MemoryFor(flow->Size()) };
    return withRequiredMemory(memory, [&]() {
      return plan.IsOptimal()
        ? std::make_shared<const AreaCorrection<D>>(*flow, plan, EqualizeOptions(), progress)
        : std::make_shared<const AreaCorrection<D>>(*flow, resolved, EqualizeOptions(), progress);
    });
  };
  // Each rank makes its own correction, the same bits as on the others: SoloRanks, and no exchange.
  return this->Areas.Get<const AreaCorrection<D>>(
    identity, SoloRanks::Get(), progress, Sharing::Process, make);
}

template TransportPlan<1> FlowCache::Plan<1>(
  const OptimalNeeds&, const FlowOptions&, InputDensity&, Progress&);
template std::shared_ptr<const AreaCorrection<1>> FlowCache::Correction<1>(
  const TransportPlan<1>&, const OptimalSetting&, const FlowOptions&, Progress&);
template TransportPlan<2> FlowCache::Plan<2>(
  const OptimalNeeds&, const FlowOptions&, InputDensity&, Progress&);
template std::shared_ptr<const AreaCorrection<2>> FlowCache::Correction<2>(
  const TransportPlan<2>&, const OptimalSetting&, const FlowOptions&, Progress&);
template TransportPlan<3> FlowCache::Plan<3>(
  const OptimalNeeds&, const FlowOptions&, InputDensity&, Progress&);
template std::shared_ptr<const AreaCorrection<3>> FlowCache::Correction<3>(
  const TransportPlan<3>&, const OptimalSetting&, const FlowOptions&, Progress&);

} // namespace RectifiedTransport::Bridge
