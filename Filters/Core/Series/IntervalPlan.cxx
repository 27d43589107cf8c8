// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/IntervalPlan.h"

#include "Core/Parallel/Stages.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// Better maps than these do not visibly change a series.
OptimalMapOptions optionsOfIntervals(std::int64_t cells)
{
  constexpr std::int64_t few = 1 << 15; // the bound is loose on coarse grids
  OptimalMapOptions options;
  options.Tolerance = 1e-2;
  options.LeastIterations = 2;
  options.RefineBound = cells <= few;
  options.InterpolatePoints = true;
  return options;
}

template <int D>
PlanEnd<D> endOf(
  const ImageGrid& box, const SeriesStep& step, const DensityArray<D, double>& values)
{
  const auto place = PlanEnd<D>::In(box, step.Grid);
  return PlanEnd<D>(PlacedDensity<D>{ values, place.Low, place.High });
}

} // namespace

double bytesOfIntervalFlows(const SeriesStep& from, const SeriesStep& to)
{
  // Tables of two densities, and the positions during the advection, in bytes a cell.
  constexpr double each = 40.0;
  return each * static_cast<double>(std::max(from.Grid.NumberOfCells(), to.Grid.NumberOfCells()));
}

template <int D>
std::unique_ptr<const TransportPlan<D>> planInterval(const SeriesStep& from, const SeriesStep& to,
  const ImageGrid& box, bool isOptimal, Progress& progress)
{
  const DensityArray<D, double> first(from.Values, from.Grid.Size<D>());
  const DensityArray<D, double> second(to.Values, to.Grid.Size<D>());
  PlanOptions options;
  options.IsOptimal = isOptimal;
  options.Optimal = optionsOfIntervals(box.NumberOfCells());
  Stages stages(progress, { { "map", isOptimal ? 1.0 : 0.0 }, { "flows", isOptimal ? 0.0 : 1.0 } });
  auto plan = std::make_unique<TransportPlan<D>>(
    endOf<D>(box, from, first), endOf<D>(box, to, second), options, stages["map"]);
  plan->MakeFlows(stages["flows"]);
  return plan;
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(planInterval);

} // namespace RectifiedTransport
