// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/SharedFlow.h"

#include "Bridge/Density/ContentHash.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/TableView.h"

#include <cmath>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// What the tables take: a record a node of each level, which has a fixed share of the nodes of the
// level before.
template <int D>
double tableBytes(const GridSize<D>& size)
{
  double nodes = 1.0;
  for (const std::int64_t cells : size)
  {
    nodes *= static_cast<double>(cells + 1);
  }
  constexpr double levels = 1.0 / (1.0 - 1.0 / (1 << (D * levelShift)));
  return nodes * levels * TableView<D>::Record * sizeof(double);
}

template <int D>
std::string describeTables(const GridSize<D>& size)
{
  return "the tables of a density of " + describeSize<D>(size) + " cells";
}

// What is held, by its content. Who holds nothing any more is forgotten at the next entry.
class Holdings
{
public:
  static Holdings& Get()
  {
    static Holdings holdings;
    return holdings;
  }

  std::shared_ptr<const SharedFlow> Find(const ContentHash& content)
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    const auto found = this->Held.find(content);
    return found == this->Held.end() ? nullptr : found->second.lock();
  }

  void Enter(const ContentHash& content, const std::shared_ptr<const SharedFlow>& flow)
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    for (auto entry = this->Held.begin(); entry != this->Held.end();)
    {
      entry = entry->second.expired() ? this->Held.erase(entry) : std::next(entry);
    }
    this->Held[content] = flow;
  }

  // Whether nobody else holds a flow; nobody finds it any more then.
  bool Withdraw(const std::shared_ptr<const SharedFlow>& flow)
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    if (flow.use_count() != 1)
    {
      return false;
    }
    for (auto entry = this->Held.begin(); entry != this->Held.end(); ++entry)
    {
      if (entry->second.lock() == flow)
      {
        this->Held.erase(entry);
        break;
      }
    }
    return true;
  }

private:
  std::mutex Access;
  std::map<ContentHash, std::weak_ptr<const SharedFlow>> Held;
};

} // namespace

std::shared_ptr<const SharedFlow> SharedFlow::Of(DensityImage& density, const ContentHash& content,
  std::shared_ptr<const SharedFlow> previous, Progress& progress, double end)
{
  Holdings& holdings = Holdings::Get();
  if (auto held = content.IsComplete() ? holdings.Find(content) : nullptr)
  {
    return held;
  }
  AnyFlow old;
  if (previous && holdings.Withdraw(previous))
  {
    old = std::move(const_cast<SharedFlow&>(*previous).Kept); // made below, and not const
  }
  previous.reset();

  constexpr double partOfPreparation = 0.1;
  progress.BeginStage(progress.StageEnd() + partOfPreparation * (end - progress.StageEnd()));
  density.Prepare(progress);
  progress.BeginStage(end);
  const auto made = std::make_shared<SharedFlow>();
  const auto build = dispatchDimension(density.Grid().Dimension(), &SharedFlow::Build<1>,
    &SharedFlow::Build<2>, &SharedFlow::Build<3>);
  ((*made).*build)(density, std::move(old), progress);
  if (content.IsComplete())
  {
    holdings.Enter(content, made);
  }
  return made;
}

// Old and new tables side by side would double the peak.
template <int D>
void SharedFlow::Build(DensityImage& density, AnyFlow previous, Progress& progress)
{
  const DensitySource<D> source = density.Source<D>();
  const GridSize<D> size = source.Size;
  withMemory(describeTables<D>(size), tableBytes<D>(size), [&]() {
    try
    {
      if (auto* memory = std::get_if<RectifiedFlow<D>>(&previous))
      {
        this->Kept = RectifiedFlow<D>(source, std::move(*memory), progress.Stage());
      }
      else
      {
        previous = std::monostate();
        this->Kept = RectifiedFlow<D>(source, progress.Stage());
      }
    }
    catch (const InvalidDensity& invalid)
    {
      density.Explain(invalid.Summary());
    }
  });
  DensitySummary found;
  found.Total = this->Flow<D>().Total() * density.Grid().CellMeasure();
  if (!(found.Total > 0.0) || std::isinf(found.Total))
  {
    density.Explain(found);
  }
  this->Mass = found.Total;
  this->Built.Modified();
}

} // namespace RectifiedTransport
