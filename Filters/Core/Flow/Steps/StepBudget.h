// SPDX-License-Identifier: BSD-3-Clause
// What numbers of steps cost, counted in velocities, so that it does not depend on the machine.
#ifndef RectifiedTransport_StepBudget_h
#define RectifiedTransport_StepBudget_h

#include "Core/Flow/FlowMapShape.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/GridSize.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

constexpr int stepUnit = 8; // numbers of steps are multiples of it

template <int Dimension>
class StepBudget
{
public:
  // The budget for as many particles as the options say; for a map, or backward, for one a cell and
  // for fewer. Flow maps are as exact as `mapSteps` steps.
  StepBudget(const GridSize<Dimension>& size, const FlowOptions& options, FlowDirection direction,
    int mapSteps)
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

  // What choosing costs.
  struct ChoiceCost
  {
    double Spent;    // velocities of the first comparison
    double Compared; // how many points take each number of steps after it,
    double Verified; // how many once the steps that are chosen
  };

  // The most steps, a multiple of 8, with which a run and the choice of its steps cost no more than
  // 8 times what a run with the fewest steps costs. In smooth densities flow maps serve nearly all
  // particles.
  int MostSteps(const ChoiceCost& choosing, bool isSmooth) const
  {
    int affordable = FlowOptions::FewestSteps;
    int excessive = 8 * FlowOptions::FewestSteps * 2;
    while (excessive - affordable > stepUnit)
    {
      const int middle = (affordable + excessive) / (2 * stepUnit) * stepUnit;
      // Until `middle` is between two numbers of steps that are compared.
      double choice = choosing.Spent + middle * choosing.Verified;
      for (int last = 4 * FlowOptions::FewestSteps; last < 4 * middle; last *= 2)
      {
        choice += last * choosing.Compared;
      }
      (this->IsAffordable(middle, choice, isSmooth) ? affordable : excessive) = middle;
    }
    return affordable;
  }

  // How many times as long as a run with a choice one with a given NumberOfSteps would take.
  double TimesOf(const StepChoice& choice, int steps) const
  {
    FlowOptions options = this->Options;
    StepBudget fixed = *this;
    fixed.MapSteps = 0;
    return fixed.Cost(steps, this->Particles[0], usualBad) /
      this->Cost(std::max(choice.NumberOfSteps, options.LeastSteps), this->Particles[0], usualBad);
  }

private:
  // Times a run with the fewest steps. Forward with room for flow maps whose cells are all bad, as
  // in uneven noise.
  static constexpr double mostCost = 8.0;
  static constexpr double mostCostIfRough = 5.5;
  // The shares of particles that flow maps do not serve: of the fewest steps, as in photographs; of
  // more.
  static constexpr double fewestBad = 0.0;
  static constexpr double usualBad = 0.2;
  static constexpr double badIfSmooth = 0.05;

  // With a share of particles that a flow map does not serve.
  double Cost(int steps, double particles, double share) const
  {
    StepChoice choice;
    choice.NumberOfSteps = steps;
    choice.MapSteps = this->MapSteps;
    FlowOptions fixed = choice.Of(this->Options);
    fixed.NumberOfSteps = steps;
    fixed = withFlowMaps<Dimension>(fixed, this->Size, this->Direction, particles);
    if (fixed.Maps == FlowMaps::On && takesFlowMaps(fixed))
    {
      const FlowMapShape<Dimension> shape(this->Size, steps, this->Direction, 0, 1, fixed.MapSteps);
      if (!shape.Levels.empty())
      {
        return shape.CostWith(particles, share);
      }
    }
    return particles * velocitiesOf(this->Direction, steps);
  }

  bool IsAffordable(int steps, double choice, bool isSmooth) const
  {
    for (std::size_t i = 0; i < this->Particles.size(); ++i)
    {
      const double ofChoice = i == 0 ? choice : 0.0;
      const double times =
        isSmooth || this->Direction == FlowDirection::Backward ? mostCost : mostCostIfRough;
      const double most = times * this->OfFewest[i];
      if (ofChoice + this->Cost(steps, this->Particles[i], isSmooth ? badIfSmooth : usualBad) >
        most)
      {
        return false;
      }
    }
    return true;
  }

  GridSize<Dimension> Size;
  FlowOptions Options;
  FlowDirection Direction;
  int MapSteps;
  std::vector<double> Particles;
  std::vector<double> OfFewest; // for each number of particles
};

} // namespace RectifiedTransport

#endif
