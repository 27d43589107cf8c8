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
  // Of those that NumberOfSteps 0 stands for.
  static constexpr int FewestSteps = 32;
  static constexpr int MostSteps = 4096;

  RectifiedTransport::Integrator Integrator = RectifiedTransport::Integrator::Multistep;
  // Of the fixed-step methods, up to 10000; 0: as many as AreaTolerance asks, by the density and
  // the direction (AutomaticSteps.h).
  int NumberOfSteps = 0;
  // With 0 steps: the largest relative error, up to 1, of the area (backward) or mass (forward) of
  // a block of 4^d cells, in 99.9 % of those that count.
  double AreaTolerance = 0.02;
  int LeastSteps = FewestSteps; // with 0 steps: not fewer than that
  // Error of a step in grid cells, Adaptive only, > 0; raised to 2^-40 of the domain's longest
  // side.
  double Tolerance = 0.01;
  TableLookup Lookup = TableLookup::Interpolated;
  FlowMaps Maps = FlowMaps::Auto;

  bool operator==(const FlowOptions& other) const
  {
    return this->Integrator == other.Integrator && this->NumberOfSteps == other.NumberOfSteps &&
      this->AreaTolerance == other.AreaTolerance && this->LeastSteps == other.LeastSteps &&
      this->Tolerance == other.Tolerance && this->Lookup == other.Lookup &&
      this->Maps == other.Maps;
  }
};

// What NumberOfSteps 0 stands for.
struct StepChoice
{
  int NumberOfSteps = FlowOptions::FewestSteps;
  double Tolerance = 0.0; // of Adaptive; 0: the integrator of the options serves
  // Estimated error of areas or masses, as of AreaTolerance; NaN where none was measured.
  double AreaError = std::numeric_limits<double>::quiet_NaN();

  // Options with these steps.
  FlowOptions Of(FlowOptions options) const
  {
    options.NumberOfSteps = std::max(this->NumberOfSteps, options.LeastSteps);
    if (this->Tolerance > 0.0)
    {
      options.Integrator = Integrator::Adaptive;
      options.Tolerance = this->Tolerance;
    }
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
  double AreaError = std::numeric_limits<double>::quiet_NaN(); // of StepChoice
};

} // namespace RectifiedTransport

#endif
