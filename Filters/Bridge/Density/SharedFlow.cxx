// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/SharedFlow.h"

#include "Bridge/Density/ContentHash.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

#include <cmath>
#include <map>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>

namespace RectifiedTransport
{

namespace
{

template <int D>
std::string describeTables(const GridSize<D>& size)
{
  return "the tables of a density of " + describeSize<D>(size) + " cells";
}

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

} // namespace

std::shared_ptr<SharedFlow> SharedFlow::FindOrBuild(InputDensity& density,
  const ContentHash& content, FlowTables tables, std::shared_ptr<SharedFlow> previous,
  Progress& progress, double end)
{
  FlowRegistry& registry = FlowRegistry::Get();
  const bool isShared = content.IsComplete() && tables == FlowTables::Whole;
  auto shared = isShared ? registry.Find(content) : nullptr;
  if (onAllRanks(progress.Group(), shared != nullptr))
  {
    return shared;
  }
  AnyFlow old;
  if (previous && registry.EraseIfUnique(previous))
  {
    old = std::move(previous->Kept);
  }
  previous.reset();

  constexpr double partOfPreparation = 0.1;
  progress.BeginStage(progress.StageEnd() + partOfPreparation * (end - progress.StageEnd()));
  density.Prepare(tables, progress);
  progress.BeginStage(end);
  const auto made = std::make_shared<SharedFlow>();
  made->Kind = tables;
  const auto build = dispatchDimension(density.Grid().Dimension(), &SharedFlow::Build<1>,
    &SharedFlow::Build<2>, &SharedFlow::Build<3>);
  ((*made).*build)(density, std::move(old), progress);
  density.ReleaseGathered(); // whole tables need no values
  if (isShared)
  {
    registry.Insert(content, made);
  }
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

// Old and new tables side by side would double the peak.
template <int D>
void SharedFlow::Build(InputDensity& density, AnyFlow previous, Progress& progress)
{
  const GridSize<D> size = density.Grid().Size<D>();
  withMemory(describeTables<D>(size), RectifiedFlow<D>::MemoryFor(size), [&]() {
    try
    {
      if (this->Kind == FlowTables::Tiled)
      {
        previous = std::monostate();
        this->Kept = RectifiedFlow<D>(density.Source<D>(), FlowTables::Tiled, progress.Stage());
      }
      else if (auto* memory = std::get_if<RectifiedFlow<D>>(&previous))
      {
        this->Kept = RectifiedFlow<D>(density.Source<D>(), std::move(*memory), progress.Stage());
      }
      else
      {
        previous = std::monostate();
        this->Kept = RectifiedFlow<D>(density.Source<D>(), progress.Stage());
      }
    }
    catch (const InvalidDensity& invalid)
    {
      density.ThrowInvalid(invalid.Summary());
    }
  });
  DensitySummary found;
  found.Total = this->Flow<D>().Total() * density.Grid().CellMeasure();
  if (!(found.Total > 0.0) || std::isinf(found.Total))
  {
    density.ThrowInvalid(found);
  }
  this->Mass = found.Total;
  this->Values = density.Unusual();
  this->Values.Found = this->Flow<D>().Summary();
  this->Built.Modified();
}

} // namespace RectifiedTransport
