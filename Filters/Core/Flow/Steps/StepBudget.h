// SPDX-License-Identifier: BSD-3-Clause
// What numbers of steps cost, counted in velocities, so that it does not depend on the machine.
#ifndef RectifiedTransport_StepBudget_h
#define RectifiedTransport_StepBudget_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/GridSize.h"

#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class StepBudget
{
public:
  // Of as many particles as the options say; of a map, or backward, of one a cell and of fewer.
  // Flow maps are as exact as `mapSteps` steps.
  StepBudget(const GridSize<Dimension>& size, const FlowOptions& options, FlowDirection direction,
    int mapSteps);

  // What choosing costs.
  struct Choosing
  {
    double Spent;    // velocities of the first comparison
    double Compared; // how many points take each number of steps after it,
    double Judged;   // how many once the steps that are chosen
  };

  // The most steps, a multiple of 8, with which a run and the choice of its steps cost no more than
  // 8 times what a run with the fewest steps costs. In smooth densities flow maps serve nearly all
  // particles.
  int MostSteps(const Choosing& choosing, bool isSmooth) const;
  // How many times as long as a run with a choice one with a given NumberOfSteps would take.
  double TimesOf(const StepChoice& choice, int steps) const;

private:
  // With a share of particles that a flow map does not serve.
  double Cost(int steps, double particles, double bad) const;
  bool IsKept(int steps, double choice, bool isSmooth) const;

  GridSize<Dimension> Size;
  FlowOptions Options;
  FlowDirection Direction;
  int MapSteps;
  std::vector<double> Particles;
  std::vector<double> OfFewest; // for each number of particles
};

} // namespace RectifiedTransport

#endif
