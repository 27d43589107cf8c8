// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/StepDensity.h"

#include "Bridge/Density/DensityMass.h"
#include "Bridge/Density/WholeValues.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Tables/DensityInspection.h"

#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

// A density without mass is none for a map, but one of a series.
void requireValues(InputDensity& density, const StepDensity& step)
{
  const DensitySummary found =
    summarize(step.Values->GetPointer(0), step.Values->GetNumberOfTuples(), 0);
  if (found.NotFinite > 0 || found.Negative > 0 || std::isinf(found.Total))
  {
    density.ThrowInvalid(found);
  }
}

template <int D>
void read(InputDensity& density, StepDensity& step, Progress& progress)
{
  step.Values = wholeValues<D>(density, step.ArrayName, progress);
  requireValues(density, step);
  step.Mass = massOf(density, progress);
  density.ReleaseGathered();
}

} // namespace

std::shared_ptr<const StepDensity> readStepDensity(
  InputDensity& density, std::shared_ptr<const StepDensity> before, Progress& progress)
{
  StepDensity step;
  step.ArrayName = density.NameOfArray();
  step.Grid = density.Grid();
  const auto isSame = [&]() {
    return before && before->ArrayName == step.ArrayName && before->Grid == step.Grid;
  };
  const Ranks& ranks = progress.Group();
  if (!ranks.AreSeveral() && isSame() && before->Content.IsOf(density))
  {
    return before;
  }
  step.Content = ContentHash(density, progress);
  if (onAllRanks(ranks, isSame() && before->Content == step.Content))
  {
    auto same = std::make_shared<StepDensity>(*before);
    same->Content = step.Content;
    return same;
  }
  dispatchDimension(step.Grid.Dimension(), read<1>, read<2>, read<3>)(density, step, progress);
  return std::make_shared<const StepDensity>(std::move(step));
}

} // namespace RectifiedTransport::Bridge
