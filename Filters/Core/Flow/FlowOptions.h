// SPDX-License-Identifier: BSD-3-Clause
// The options and the report of an advection.
#ifndef RectifiedTransport_FlowOptions_h
#define RectifiedTransport_FlowOptions_h

#include <algorithm>
#include <cstdint>
#include <limits>

namespace RectifiedTransport
{

enum class Integrator
{
  Multistep,   // graded Adams-Bashforth-Moulton 3, one velocity a step
  RungeKutta4, // uniform steps, four velocities a step (the paper's Algorithm 2)
  Euler,       // uniform steps
  Adaptive     // Adams-Bashforth-Moulton 3 with the step chosen for each particle
};

enum class TableLookup
{
  Interpolated,
  Nearest // the box is rounded to whole grid cells (the paper's ablation, Figure 4)
};

// Lattices of seeds that carry the smooth part of the flow (FlowMap.h): for Multistep with
// Interpolated, in 2D and 3D, if the density has enough cells for the steps (FlowMapShape.h).
enum class FlowMaps
{
  Auto, // if they take less time for the number of particles, including the time to make them
  On,   // if there are any
  Off
};

enum class FlowDirection
{
  Forward,
  Backward
};

struct FlowOptions
{
  static constexpr int MaximumNumberOfSteps = 10000;
  // The range of what NumberOfSteps 0 stands for.
  static constexpr int FewestSteps = 32;
  static constexpr int MostSteps = 4096;
  // With this AreaTolerance, 0 steps cost at most 8 times as much as LeastSteps.
  static constexpr double UsualTolerance = 0.02;

  RectifiedTransport::Integrator Integrator = RectifiedTransport::Integrator::Multistep;
  // The number of steps of the fixed-step methods, up to 10000; 0: as many as AreaTolerance asks,
  // by the density, the direction and Particles (AutomaticSteps.h).
  int NumberOfSteps = 0;
  // With 0 steps: the largest error, up to 1, of the area (backward) or mass (forward) of blocks,
  // for 99.9 % of them, relative to their mass or 5 % of the mean block's. Of blocks of 4^d cells,
  // or that hold AreaTolerance^(-4/3) of the Particles.
  double AreaTolerance = UsualTolerance;
  int LeastSteps = FewestSteps; // with 0 steps: not fewer than that
  // With 0 steps: whether AreaError tells the error of the steps that are taken. Else it is that of
  // the choice, which costs less and may be off by several times.
  bool NeedsEstimate = true;
  // With 0 steps, forward: how many particles show the density, on all ranks, so that smaller
  // blocks do not matter; 0: a map.
  double Particles = 0.0;
  // Error of a step in grid cells, Adaptive only, > 0; raised to 2^-40 of the domain's longest
  // side.
  double Tolerance = 0.01;
  TableLookup Lookup = TableLookup::Interpolated;
  FlowMaps Maps = FlowMaps::Auto;
  int MapSteps = 0; // maps are as exact as so many steps; 0: as NumberOfSteps

  bool operator==(const FlowOptions& other) const
  {
    return this->Integrator == other.Integrator && this->NumberOfSteps == other.NumberOfSteps &&
      this->AreaTolerance == other.AreaTolerance && this->LeastSteps == other.LeastSteps &&
      this->NeedsEstimate == other.NeedsEstimate && this->Particles == other.Particles &&
      this->Tolerance == other.Tolerance && this->Lookup == other.Lookup &&
      this->Maps == other.Maps && this->MapSteps == other.MapSteps;
  }
};

// What NumberOfSteps 0 stands for.
struct StepChoice
{
  int NumberOfSteps = FlowOptions::FewestSteps;
  // Estimated error of areas or masses, as of AreaTolerance; NaN where none was measured.
  double AreaError = std::numeric_limits<double>::quiet_NaN();
  // Where that is above the tolerance: the steps that would reach it, above MaximumNumberOfSteps if
  // none do, and how many times as long they would take.
  int StepsNeeded = 0;
  double TimesNeeded = 0.0;
  int MapSteps = 0; // as in the options

  // Options with these steps.
  FlowOptions Of(FlowOptions options) const
  {
    options.MapSteps = this->NumberOfSteps >= options.LeastSteps ? this->MapSteps : 0;
    options.NumberOfSteps = std::max(this->NumberOfSteps, options.LeastSteps);
    return options;
  }
};

struct FlowReport
{
  // Particles that met an empty box or ended in an empty cell on their way from the seed itself.
  std::int64_t Redone = 0;
  std::int64_t MovedToMass = 0; // those still in an empty cell: put on the nearest mass
  // The cost: velocity evaluations, including those of flow maps made for this run. Particles that
  // are redone together share some, so that it may differ a little from run to run.
  std::int64_t Evaluations = 0;
  int NumberOfSteps = 0; // that particles took; 0 with Adaptive, where each has its own
  // Those of StepChoice.
  double AreaError = std::numeric_limits<double>::quiet_NaN();
  int StepsNeeded = 0;
  double TimesNeeded = 0.0;

  void Add(const StepChoice& choice)
  {
    this->AreaError = choice.AreaError;
    this->StepsNeeded = choice.StepsNeeded;
    this->TimesNeeded = choice.TimesNeeded;
  }
};

} // namespace RectifiedTransport

#endif
