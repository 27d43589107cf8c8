// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/TargetTransport.h"

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/PairMap.h"
#include "Bridge/Image/CommonGrid.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

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
  const DensityPair& pair, const OptimalSetting& setting, Progress& progress, double end)
{
  if (!setting.NeedsMap())
  {
    this->Kept.reset();
    progress.BeginStage(end);
    return nullptr;
  }
  constexpr double partOfHashes = 0.02;
  const Ranks& ranks = progress.Group();
  const double begin = progress.StageEnd();
  const bool hasTimes = onAllRanks(ranks, this->HasTimesOf(pair));
  if (!hasTimes)
  {
    progress.BeginStage(begin + 0.5 * partOfHashes * (end - begin));
    const ContentHash source(pair.Source, progress);
    progress.BeginStage(begin + partOfHashes * (end - begin));
    const ContentHash target(pair.Target, progress);
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
    constexpr double partOfReading = 0.05;
    progress.BeginStage(begin + partOfReading * (end - begin));
    pair.Source.Prepare(FlowTables::Whole, progress);
    this->Kept = std::shared_ptr<const OptimalMap<D>>(
      solvePair<D>(pair.Box, placeDensity<D>(pair.Box, pair.Source.Grid(), pair.Source.Source<D>()),
        pair.Target, { setting, leastIterations(setting), true }, progress, end));
    pair.Source.ReleaseGathered();
    this->Setting = setting;
    this->SourceGrid = pair.Source.Grid();
    this->TargetGrid = pair.Target.Grid();
  }
  progress.BeginStage(end);
  return std::static_pointer_cast<const OptimalMap<D>>(this->Kept);
}

template std::shared_ptr<const OptimalMap<1>> TargetTransport::Map<1>(
  const DensityPair&, const OptimalSetting&, Progress&, double);
template std::shared_ptr<const OptimalMap<2>> TargetTransport::Map<2>(
  const DensityPair&, const OptimalSetting&, Progress&, double);
template std::shared_ptr<const OptimalMap<3>> TargetTransport::Map<3>(
  const DensityPair&, const OptimalSetting&, Progress&, double);

} // namespace RectifiedTransport::Bridge
