// SPDX-License-Identifier: BSD-3-Clause
// Plans between densities of inputs: what they are asked for, what they need, and what outputs and
// warnings say of them.
#ifndef RectifiedTransport_DensityPlan_h
#define RectifiedTransport_DensityPlan_h

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/Settings/TransportSettings.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Parallel/Stages.h"
#include "Core/Plan/TransportPlan.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace RectifiedTransport::Bridge
{

// What an optimal map is wanted for.
struct OptimalNeeds
{
  OptimalSetting Setting;
  double Samples = 0.0; // that the map moves together, of all ranks

  OptimalMapUse Use(const Ranks& ranks) const
  {
    OptimalMapUse use;
    use.Samples = this->Setting.IsOptimal ? this->Samples : 0.0;
    use.OnSeveralRanks = ranks.AreSeveral();
    return use;
  }
  // For a map that is there. Throws Failure if the memory is not there.
  template <int D>
  void RequireForSamples(const GridSize<D>& target, const Ranks& ranks) const
  {
    requireMemory({ std::string("the exact counts of particles (") + this->Setting.Advice() + ")",
      TransportPlan<D>::MemoryForSamples(target, this->Use(ranks)) });
  }
};

// `densities` are those of the map, for messages.
template <int D>
MemoryPlan memoryOfOptimalMap(const std::string& densities, const GridSize<D>& source,
  const GridSize<D>& target, const OptimalNeeds& needs, const Ranks& ranks)
{
  return { "the optimal map " + densities + " (" + needs.Setting.Advice() + ")",
    TransportPlan<D>::MemoryFor(source, target, OptimalMapOptions(), needs.Use(ranks)) };
}

template <int D>
MemoryPlan memoryOfOptimalMap(const GridSize<D>& source, const GridSize<D>& target,
  const OptimalNeeds& needs, const Ranks& ranks)
{
  return memoryOfOptimalMap<D>("between densities of " + describeSize<D>(source) + " and " +
      describeSize<D>(target) + " cells",
    source, target, needs, ranks);
}

inline PlanOptions planOptions(const OptimalSetting& setting, const FlowOptions& flow)
{
  PlanOptions options;
  options.IsOptimal = setting.IsOptimal;
  options.HasBound = setting.Certifies;
  options.Flow = flow;
  options.Optimal.Tolerance = setting.Tolerance;
  return options;
}

// The density of an input, at its place. It must outlive the plan.
template <int D>
PlanEnd<D> planEnd(PlanEnd<D> place, InputDensity& density)
{
  place.Read = [&density](const Context& context) {
    Progress progress(context);
    density.Prepare(FlowTables::Whole, progress);
    return density.Source<D>();
  };
  place.Release = [&density]() { density.ReleaseGathered(); };
  return place;
}

// What a filter tells about the plan that it took.
struct TransportReport
{
  TransportReport() = default;
  template <int D>
  explicit TransportReport(const TransportPlan<D>& plan)
    : IsOptimal(plan.IsOptimal())
    , Warning(plan.Warning())
  {
  }

  // Ends a warning about samples that more steps would help.
  const char* WithSteps(const char* advice) const { return this->IsOptimal ? "" : advice; }

  bool IsOptimal = false;
  std::string Warning; // why the flow moves the points with Method Optimal; else empty
};

// TransportCostLowerBound, and OptimalityGap of a map of this cost on a grid. Where the bound is no
// more than the rounding that it allows for (see PotentialSolver), their ratio says nothing: the
// gap is 0 for ways of less than a tenth of a cell, which are errors of integration, else infinite.
inline void addCostBound(vtkDataObject* output, double bound, double cost, const ImageGrid& grid)
{
  constexpr double rounding = 1e-12; // relative to the squared diagonal
  double gap = std::max(0.0, cost / bound - 1.0);
  if (!(bound > rounding * grid.Diagonal() * grid.Diagonal()))
  {
    constexpr double nothing = 0.1; // cells
    const double cell = std::pow(grid.CellMeasure(), 1.0 / grid.Dimension());
    const bool isNothing = std::sqrt(cost) <= nothing * cell;
    gap = isNothing ? 0.0 : std::numeric_limits<double>::infinity();
  }
  addFieldValue(output, "TransportCostLowerBound", bound);
  addFieldValue(output, "OptimalityGap", gap);
}

// The same of a plan, whose lengths are in the LengthScale of `box`; nothing if it has no bound.
// Throws std::overflow_error as LengthScale.
template <int D>
void addBound(const TransportPlan<D>& plan, const ImageGrid& box, double cost,
  const ImageGrid& grid, vtkDataObject* output)
{
  if (plan.Certificate())
  {
    addCostBound(output, LengthScale(box).CostFromUnits(plan.LowerBound()), cost, grid);
  }
}

// The array Slack of points and their images, in squared physical units of a plan that has a map
// and lengths in the LengthScale of `box`. Throws Failure and Cancelled.
template <int D>
vtkSmartPointer<vtkDoubleArray> slackOf(const TransportPlan<D>& plan, const ImageGrid& box,
  ConstPointSpan<D> points, ConstPointSpan<D> images, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const std::int64_t count = points.size();
  const LengthScale scale(box);
  auto array = newArray<vtkDoubleArray>("Slack", 1, count);
  double* slack = array->GetPointer(0);
  Stages stages(progress, { { "slack", 9 }, { "units", 1 } });
  plan.Certificate()->Slack(points, images, slack, stages["slack"]);
  stages["units"].ForEach(
    count, grain, [=](std::int64_t i) { slack[i] = scale.SquareFromUnits(slack[i]); });
  return array;
}

} // namespace RectifiedTransport::Bridge

#endif
