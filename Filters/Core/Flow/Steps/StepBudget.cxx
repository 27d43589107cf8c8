// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Steps/StepBudget.h"

#include "Core/Flow/FlowMapShape.h"

#include <algorithm>
#include <cstddef>

namespace RectifiedTransport
{

namespace
{

// Times a run with the fewest steps. Forward with room for flow maps whose cells are all bad, as in
// uneven noise.
constexpr double mostCost = 8.0;
constexpr double mostCostIfRough = 5.5;
// The shares of particles that flow maps do not serve: of the fewest steps, as in photographs; of
// more.
constexpr double fewestBad = 0.0;
constexpr double bad = 0.2;
constexpr double badIfSmooth = 0.05;
constexpr int unit = 8; // of numbers of steps

template <int Dimension>
FlowMapShape<Dimension> shapeOf(
  const FlowOptions& options, const GridSize<Dimension>& size, FlowDirection direction)
{
  return FlowMapShape<Dimension>(size, options.NumberOfSteps, direction, 0, 1, options.MapSteps);
}

} // namespace

template <int Dimension>
StepBudget<Dimension>::StepBudget(const GridSize<Dimension>& size, const FlowOptions& options,
  FlowDirection direction, int mapSteps)
  : Size(size)
  , Options(options)
  , Direction(direction)
  , MapSteps(mapSteps)
{
  const double cells = numberOfCells<Dimension>(size);
  const bool isKnown = direction == FlowDirection::Forward && options.Particles > 0.0;
  this->Particles.push_back(isKnown ? options.Particles : cells);
  // Flow maps serve larger numbers with few steps than with many.
  for (double part = 4.0; !isKnown && part <= 16.0; part *= 4.0)
  {
    this->Particles.push_back(cells / part);
  }
  for (const double particles : this->Particles)
  {
    this->OfFewest.push_back(this->Cost(FlowOptions::FewestSteps, particles, fewestBad));
  }
}

template <int Dimension>
double StepBudget<Dimension>::Cost(int steps, double particles, double share) const
{
  StepChoice choice;
  choice.NumberOfSteps = steps;
  choice.MapSteps = this->MapSteps;
  FlowOptions fixed = choice.Of(this->Options);
  fixed.NumberOfSteps = steps;
  fixed = withFlowMaps<Dimension>(fixed, this->Size, this->Direction, particles);
  if (fixed.Maps == FlowMaps::On && takesFlowMaps(fixed))
  {
    const auto shape = shapeOf<Dimension>(fixed, this->Size, this->Direction);
    if (!shape.Levels.empty())
    {
      return shape.CostWith(particles, share);
    }
  }
  return particles * velocitiesOf(this->Direction, steps);
}

template <int Dimension>
bool StepBudget<Dimension>::IsKept(int steps, double choice, bool isSmooth) const
{
  for (std::size_t i = 0; i < this->Particles.size(); ++i)
  {
    const double ofChoice = i == 0 ? choice : 0.0;
    const double times =
      isSmooth || this->Direction == FlowDirection::Backward ? mostCost : mostCostIfRough;
    const double most = times * this->OfFewest[i];
    if (ofChoice + this->Cost(steps, this->Particles[i], isSmooth ? badIfSmooth : bad) > most)
    {
      return false;
    }
  }
  return true;
}

template <int Dimension>
int StepBudget<Dimension>::MostSteps(const Choosing& choosing, bool isSmooth) const
{
  int kept = FlowOptions::FewestSteps;
  int missed = 8 * FlowOptions::FewestSteps * 2;
  while (missed - kept > unit)
  {
    const int middle = (kept + missed) / (2 * unit) * unit;
    // Until `middle` is between two numbers of steps that are compared.
    double choice = choosing.Spent + middle * choosing.Judged;
    for (int last = 4 * FlowOptions::FewestSteps; last < 4 * middle; last *= 2)
    {
      choice += last * choosing.Compared;
    }
    (this->IsKept(middle, choice, isSmooth) ? kept : missed) = middle;
  }
  return kept;
}

template <int Dimension>
double StepBudget<Dimension>::TimesOf(const StepChoice& choice, int steps) const
{
  FlowOptions options = this->Options;
  StepBudget fixed = *this;
  fixed.MapSteps = 0;
  return fixed.Cost(steps, this->Particles[0], bad) /
    this->Cost(std::max(choice.NumberOfSteps, options.LeastSteps), this->Particles[0], bad);
}

template class StepBudget<1>;
template class StepBudget<2>;
template class StepBudget<3>;

} // namespace RectifiedTransport
