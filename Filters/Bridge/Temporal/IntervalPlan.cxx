// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/IntervalPlan.h"

#include "Bridge/Density/OptimalMemory.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Temporal/StepDensity.h"
#include "Core/Geometry/Boxes/CommonGrid.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr int anyDimensions[3] = { 0, 0, 0 };

// About what whole tables and the advection of points take.
constexpr double bytesOfTables = 40.0;

// What a series shows changes no more with better ones.
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
  const ImageGrid& box, const StepDensity& step, const DensityArray<D, double>& values)
{
  const auto place = PlanEnd<D>::In(box, step.Grid);
  return PlanEnd<D>(PlacedDensity<D>{ values, place.Low, place.High });
}

} // namespace

template <int D>
IntervalPlan<D>::IntervalPlan(const StepDensity& from, const StepDensity& to, bool isOptimal,
  double samples, Progress& progress)
  : From(from.template Density<D>())
  , To(to.template Density<D>())
{
  const ImageGrid box =
    commonGrid({ { from.Grid, "" }, { to.Grid, "" } }, anyDimensions, MostCells::Any);
  PlanOptions options;
  options.IsOptimal = isOptimal;
  options.Optimal = optionsOfIntervals(box.NumberOfCells());
  OptimalNeeds needs{ {}, samples };
  needs.Setting.IsOptimal = isOptimal;
  const double cells =
    static_cast<double>(std::max(from.Grid.NumberOfCells(), to.Grid.NumberOfCells()));
  const MemoryPlan memory = isOptimal
    ? memoryOfOptimalMap<D>(from.Grid.Size<D>(), to.Grid.Size<D>(), needs, progress.Group())
    : MemoryPlan{ "the tables of a density", bytesOfTables * cells };
  Stages stages(progress, { { "map", isOptimal ? 1.0 : 0.0 }, { "flows", isOptimal ? 0.0 : 1.0 } });
  withRequiredMemory(memory, [&]() {
    this->Plan.emplace(
      endOf<D>(box, from, this->From), endOf<D>(box, to, this->To), options, stages["map"]);
    this->Plan->MakeFlows(stages["flows"]);
  });
  this->Bound = LengthScale(box).CostFromUnits(this->Plan->LowerBound());
}

template class IntervalPlan<1>;
template class IntervalPlan<2>;
template class IntervalPlan<3>;

} // namespace RectifiedTransport::Bridge
