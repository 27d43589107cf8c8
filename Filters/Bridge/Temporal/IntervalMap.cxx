// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/IntervalMap.h"

#include "Bridge/Density/CostBound.h"
#include "Bridge/Density/PairMap.h"
#include "Bridge/Image/CommonGrid.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Temporal/StepDensity.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/Stages.h"

#include <cstddef>
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

} // namespace

template <int D>
IntervalMap<D>::IntervalMap(const StepDensity& from, const StepDensity& to, bool isOptimal,
  double samples, Progress& progress)
  : From(from)
  , To(to)
{
  if (isOptimal)
  {
    this->Solve(samples, progress);
  }
  if (!this->Map)
  {
    this->MakeFlows(progress);
  }
}

template <int D>
void IntervalMap<D>::Solve(double samples, Progress& progress)
{
  const ImageGrid box =
    commonGrid({ { this->From.Grid, "" }, { this->To.Grid, "" } }, anyDimensions, MostCells::Any);
  OptimalSetting setting;
  setting.IsOptimal = true;
  const OptimalMemory memory = memoryOfPair<D>(this->From.Grid.template Size<D>(),
    this->To.Grid.template Size<D>(), { setting, samples }, progress.Group());
  memory.Require();
  const OptimalMapOptions options = optionsOfIntervals(box.NumberOfCells());
  Stages stages(progress, { { "reading", 5 }, { "solution", 85 }, { "check", 10 } });
  const auto from = this->From.template Density<D>();
  const auto to = this->To.template Density<D>();
  const LengthScale scale(box);
  withMemory(memory.Purpose, memory.Bytes, [&]() {
    this->Map = std::make_unique<OptimalMap<D>>(placeDensity<D>(box, this->From.Grid, from),
      placeDensity<D>(box, this->To.Grid, to), options, stages["reading"]);
    this->Map->Solve(stages["solution"]);
    this->Text = unresolvedText(this->Map->MassError(stages["check"]));
  });
  this->Bound = scale.CostFromUnits(this->Map->LowerBound());
  if (!this->Text.empty())
  {
    this->Map = nullptr;
  }
}

template <int D>
void IntervalMap<D>::MakeFlows(Progress& progress)
{
  Stages stages(progress, { { "first", 1 }, { "second", 1 } });
  const auto make = [](const StepDensity& step, Progress& making) {
    const double bytes = bytesOfTables * static_cast<double>(step.Grid.NumberOfCells());
    const auto density = step.template Density<D>();
    return withMemory("the tables of a density", bytes,
      [&]() { return std::make_unique<RectifiedFlow<D>>(density, making); });
  };
  this->FromFlow = make(this->From, stages["first"]);
  this->ToFlow = make(this->To, stages["second"]);
}

template <int D>
void IntervalMap<D>::Follow(const RectifiedFlow<D>& back, const RectifiedFlow<D>& on,
  PointSpan<D> points, Progress& progress) const
{
  back.Backward(ConstPointSpan<D>(points), points, {}, progress);
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      points[i][axis] *=
        static_cast<double>(on.Size()[axis]) / static_cast<double>(back.Size()[axis]);
    }
  }
  on.Forward(ConstPointSpan<D>(points), points, {}, progress);
}

template <int D>
void IntervalMap<D>::Forward(PointSpan<D> points, bool areSamples, Progress& progress) const
{
  if (!this->Map)
  {
    this->Follow(*this->FromFlow, *this->ToFlow, points, progress);
    return;
  }
  const FlowSeeds<D> seeds{ ConstPointSpan<D>(points) };
  this->Map->Forward(areSamples ? seeds.AsSamples() : seeds, points, {}, progress);
}

template <int D>
void IntervalMap<D>::Backward(PointSpan<D> points, Progress& progress) const
{
  if (!this->Map)
  {
    this->Follow(*this->ToFlow, *this->FromFlow, points, progress);
    return;
  }
  this->Map->Backward(ConstPointSpan<D>(points), points, {}, progress);
}

template class IntervalMap<1>;
template class IntervalMap<2>;
template class IntervalMap<3>;

} // namespace RectifiedTransport::Bridge
