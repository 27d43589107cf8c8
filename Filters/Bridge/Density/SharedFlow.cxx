// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/SharedFlow.h"

#include "Bridge/Density/ContentHash.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <cmath>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// The flows in use by any filter of the process, by the content of their densities. Expired entries
// are erased at the next insertion.
class FlowRegistry
{
public:
  static FlowRegistry& Get()
  {
    static FlowRegistry registry;
    return registry;
  }

  std::shared_ptr<SharedFlow> Find(const ContentHash& content)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = this->Entries.find(content);
    return found == this->Entries.end() ? nullptr : found->second.lock();
  }

  void Insert(const ContentHash& content, const std::shared_ptr<SharedFlow>& flow)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
    {
      entry = entry->second.expired() ? this->Entries.erase(entry) : std::next(entry);
    }
    this->Entries[content] = flow;
  }

  // Erases a flow that has no other owner, so that Find cannot return it. Returns whether it has
  // none.
  bool EraseIfUnique(const std::shared_ptr<SharedFlow>& flow)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (flow.use_count() != 1)
    {
      return false;
    }
    for (auto entry = this->Entries.begin(); entry != this->Entries.end(); ++entry)
    {
      if (entry->second.lock() == flow)
      {
        this->Entries.erase(entry);
        break;
      }
    }
    return true;
  }

private:
  std::mutex Mutex;
  std::map<ContentHash, std::weak_ptr<SharedFlow>> Entries;
};

template <int D>
OptimalMemory memoryOfMap(const GridSize<D>& size, const OptimalNeeds& needs, const Ranks& ranks)
{
  return OptimalMemory::Of<D>(
    "of a density of " + describeSize<D>(size) + " cells", size, size, needs, ranks);
}

} // namespace

template <int D>
SharedFlow::SharedFlow(RectifiedFlow<D> flow, FlowTables tables, const InputDensity& density)
  : Kept(std::move(flow))
  , Kind(tables)
  , Mass(this->Flow<D>().Total() * density.Grid().CellMeasure())
{
  if (!(this->Mass > 0.0) || std::isinf(this->Mass))
  {
    DensitySummary found;
    found.Total = this->Mass;
    density.ThrowInvalid(found);
  }
  this->Values = density.Unusual();
  this->Values.Found = this->Flow<D>().Summary();
  this->Built.Modified();
}

template <int D>
std::shared_ptr<SharedFlow> SharedFlow::FindOrBuild(InputDensity& density,
  const ContentHash& content, FlowTables tables, const OptimalNeeds& needs,
  std::shared_ptr<SharedFlow> previous, Progress& progress)
{
  FlowRegistry& registry = FlowRegistry::Get();
  const bool isShared = content.IsComplete() && tables == FlowTables::Whole;
  auto shared = isShared ? registry.Find(content) : nullptr;
  if (onAllRanks(progress.Group(), shared != nullptr))
  {
    return shared;
  }
  // Whole tables use its memory again: old and new tables side by side would double the peak.
  std::optional<RectifiedFlow<D>> old;
  if (previous && registry.EraseIfUnique(previous) && tables == FlowTables::Whole)
  {
    if (auto* flow = std::get_if<RectifiedFlow<D>>(&previous->Kept))
    {
      old = std::move(*flow);
    }
  }
  previous.reset();
  if (needs.Setting.NeedsMap())
  {
    const GridSize<D> size = density.Grid().Size<D>();
    memoryOfMap<D>(size, needs, progress.Group())
      .Require(old ? 0.0 : RectifiedFlow<D>::MemoryFor(size));
  }

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
    failOutOfMemory(caught, "the tables of a density of " + describeSize<D>(size) + " cells",
      RectifiedFlow<D>::MemoryFor(size));
  }
  density.ReleaseGathered(); // whole tables need no values
  if (isShared)
  {
    registry.Insert(content, made);
  }
  return made;
}

template <int D>
std::shared_ptr<const OptimalMap<D>> SharedFlow::Optimal(const OptimalNeeds& needs,
  InputDensity& density, std::shared_ptr<const void> previous, Progress& progress) const
{
  const ImageGrid& grid = density.Grid();
  const GridSize<D> size = grid.Size<D>();
  const OptimalMapKey key(needs.Setting, grid);
  std::shared_ptr<const OptimalMap<D>> found = this->Maps.Find<OptimalMap<D>>(key);
  if (onAllRanks(progress.Group(), found != nullptr))
  {
    return found;
  }
  found.reset();
  previous.reset(); // two side by side would double the peak
  OptimalMapOptions options;
  options.Tolerance = needs.Setting.Tolerance;
  const OptimalMemory memory = memoryOfMap<D>(size, needs, progress.Group());
  memory.Require();

  Stages stages(progress, { { "reading", 2 }, { "set-up", 3 }, { "solution", 95 } });
  density.Prepare(FlowTables::Whole, stages["reading"]);
  const LengthScale scale(grid);
  Point<D> sides = grid.Lengths<D>();
  for (double& side : sides)
  {
    side = scale.ToUnits(side);
  }
  auto made = withMemory(memory.Purpose, memory.Bytes, [&]() {
    auto map =
      std::make_shared<OptimalMap<D>>(density.Source<D>(), sides, options, stages["set-up"]);
    density.ReleaseGathered();
    map->Solve(stages["solution"]);
    return map;
  });
  this->Maps.Insert(key, made);
  return made;
}

template <int D>
std::shared_ptr<const AreaCorrection<D>> SharedFlow::Correction(
  const DensityTransport<D>& transport, const FlowOptions& options,
  std::shared_ptr<const void> previous, Progress& progress) const
{
  const RectifiedFlow<D>& flow = this->Flow<D>();
  // Nothing of them is used by an optimal map.
  const FlowOptions resolved = transport.Report().IsOptimal
    ? FlowOptions()
    : AreaCorrection<D>::Resolve(flow, options, progress);
  const auto key = std::make_pair(resolved, transport.MapKey());
  if (auto found = this->Corrections.Find<AreaCorrection<D>>(key))
  {
    return found;
  }
  previous.reset(); // two side by side would double the peak
  const std::string purpose =
    "the areas of " + describeSize<D>(flow.Size()) + " cells (EqualizeAreas Off needs none)";
  const double bytes = AreaCorrection<D>::MemoryFor(flow.Size());
  requireMemory(purpose, bytes);
  auto made = withMemory(purpose, bytes, [&]() {
    return std::make_shared<const AreaCorrection<D>>(
      flow, transport.Points(), resolved, EqualizeOptions(), progress);
  });
  this->Corrections.Insert(key, made);
  return made;
}

void SharedFlow::Attach(InputDensity& density, Progress& progress)
{
  if (this->Kind == FlowTables::Tiled)
  {
    density.Prepare(this->Kind, progress);
    const auto set = [&](auto dimension) {
      constexpr int D = decltype(dimension)::value;
      if (auto* flow = std::get_if<RectifiedFlow<D>>(&this->Kept))
      {
        flow->SetDensity(density.Source<D>());
      }
    };
    set(std::integral_constant<int, 2>());
    set(std::integral_constant<int, 3>());
  }
}

template std::shared_ptr<const OptimalMap<1>> SharedFlow::Optimal<1>(
  const OptimalNeeds&, InputDensity&, std::shared_ptr<const void>, Progress&) const;
template std::shared_ptr<const OptimalMap<2>> SharedFlow::Optimal<2>(
  const OptimalNeeds&, InputDensity&, std::shared_ptr<const void>, Progress&) const;
template std::shared_ptr<const OptimalMap<3>> SharedFlow::Optimal<3>(
  const OptimalNeeds&, InputDensity&, std::shared_ptr<const void>, Progress&) const;
template std::shared_ptr<const AreaCorrection<1>> SharedFlow::Correction<1>(
  const DensityTransport<1>&, const FlowOptions&, std::shared_ptr<const void>, Progress&) const;
template std::shared_ptr<const AreaCorrection<2>> SharedFlow::Correction<2>(
  const DensityTransport<2>&, const FlowOptions&, std::shared_ptr<const void>, Progress&) const;
template std::shared_ptr<const AreaCorrection<3>> SharedFlow::Correction<3>(
  const DensityTransport<3>&, const FlowOptions&, std::shared_ptr<const void>, Progress&) const;
template std::shared_ptr<SharedFlow> SharedFlow::FindOrBuild<1>(InputDensity&, const ContentHash&,
  FlowTables, const OptimalNeeds&, std::shared_ptr<SharedFlow>, Progress&);
template std::shared_ptr<SharedFlow> SharedFlow::FindOrBuild<2>(InputDensity&, const ContentHash&,
  FlowTables, const OptimalNeeds&, std::shared_ptr<SharedFlow>, Progress&);
template std::shared_ptr<SharedFlow> SharedFlow::FindOrBuild<3>(InputDensity&, const ContentHash&,
  FlowTables, const OptimalNeeds&, std::shared_ptr<SharedFlow>, Progress&);

} // namespace RectifiedTransport::Bridge
