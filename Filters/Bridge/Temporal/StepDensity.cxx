// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/StepDensity.h"

#include "Bridge/Density/DensityMass.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Tables/DensityInspection.h"

#include <cmath>

namespace RectifiedTransport
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
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  density.Prepare(FlowTables::Whole, progress);
  const std::shared_ptr<const DensityValues> whole = density.Source<D>().Whole();
  const std::int64_t cells = step.Grid.NumberOfCells();
  step.Values = newArray<vtkDoubleArray>(step.ArrayName, 1, cells);
  double* values = step.Values->GetPointer(0);
  progress.For(cells, grain, [&](std::int64_t first, std::int64_t last) {
    whole->Read(first, last - first, values + first);
  });
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

} // namespace RectifiedTransport
