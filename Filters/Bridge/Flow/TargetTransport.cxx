// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/TargetTransport.h"

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/PairMap.h"
#include "Bridge/Image/CommonGrid.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

// The box alone matters: few values, however fine the densities are and however far apart.
ImageGrid boxOf(const NamedGrid& source, const NamedGrid& target)
{
  int values[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    values[axis] = source.Grid.IsAxis(axis) ? 2 : 1;
  }
  return commonGrid({ source, target }, values, MostCells::Any);
}

} // namespace

DensityPair::DensityPair(InputDensity& source, const std::string& sourceName, InputDensity& target,
  const std::string& targetName)
  : Source(source)
  , Target(target)
  , SourceName(sourceName)
  , TargetName(targetName)
  , Box(boxOf({ source.Grid(), sourceName }, { target.Grid(), targetName }))
{
}

bool TargetTransport::IsFor(const DensityPair& pair, const OptimalSetting& setting) const
{
  return this->Kept && this->Setting == setting && this->SourceGrid == pair.Source.Grid() &&
    this->TargetGrid == pair.Target.Grid();
}

template <int D>
std::shared_ptr<const OptimalMap<D>> TargetTransport::Map(
  const DensityPair& pair, const OptimalSetting& setting, Progress& progress)
{
  if (!setting.NeedsMap())
  {
    this->Kept.reset();
    return nullptr;
  }
  Stages stages(
    progress, { { "source hash", 1 }, { "target hash", 1 }, { "reading", 3 }, { "solution", 95 } });
  const Ranks& ranks = progress.Group();
  const bool hasTimes = onAllRanks(ranks, this->HasTimesOf(pair));
  if (!hasTimes)
  {
    const ContentHash source(pair.Source, stages["source hash"]);
    const ContentHash target(pair.Target, stages["target hash"]);
    if (!onAllRanks(ranks, this->Source == source && this->Target == target))
    {
      this->Kept.reset();
    }
    this->Source = source;
    this->Target = target;
  }
  if (!onAllRanks(ranks, this->IsFor(pair, setting)))
  {
    this->Kept.reset();
    pair.Source.Prepare(FlowTables::Whole, stages["reading"]);
    this->Kept = std::shared_ptr<const OptimalMap<D>>(
      solvePair<D>(pair.Box, placeDensity<D>(pair.Box, pair.Source.Grid(), pair.Source.Source<D>()),
        pair.Target, { setting, leastIterations(setting), true }, stages["solution"]));
    pair.Source.ReleaseGathered();
    this->Setting = setting;
    this->SourceGrid = pair.Source.Grid();
    this->TargetGrid = pair.Target.Grid();
  }
  return std::static_pointer_cast<const OptimalMap<D>>(this->Kept);
}

template std::shared_ptr<const OptimalMap<1>> TargetTransport::Map<1>(
  const DensityPair&, const OptimalSetting&, Progress&);
template std::shared_ptr<const OptimalMap<2>> TargetTransport::Map<2>(
  const DensityPair&, const OptimalSetting&, Progress&);
template std::shared_ptr<const OptimalMap<3>> TargetTransport::Map<3>(
  const DensityPair&, const OptimalSetting&, Progress&);

} // namespace RectifiedTransport::Bridge
