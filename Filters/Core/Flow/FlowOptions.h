// SPDX-License-Identifier: BSD-3-Clause
// How an advection is done, and how it went.
#ifndef RectifiedTransport_FlowOptions_h
#define RectifiedTransport_FlowOptions_h

#include <cstdint>

namespace RectifiedTransport
{

enum class Integrator
{
  Multistep,   // graded Adams-Bashforth-Moulton 3, one velocity a step
  RungeKutta4, // uniform steps, four velocities a step (the paper's Algorithm 2)
  Euler,       // uniform steps
  Adaptive     // Adams-Bashforth-Moulton 3 with a step of its own for every particle
};

enum class TableLookup
{
  Interpolated,
  Nearest // the box is rounded to whole cells (the paper's ablation, Figure 4)
};

struct FlowOptions
{
  Integrator Method = Integrator::Multistep;
  int NumberOfSteps = 32; // of the fixed-step methods, 1 to 10000
  // Cells, Adaptive only, > 0. Less than 2^-40 of the domain's longest side is taken to be that.
  double Tolerance = 0.01;
  TableLookup Lookup = TableLookup::Interpolated;

  bool operator==(const FlowOptions& other) const
  {
    return this->Method == other.Method && this->NumberOfSteps == other.NumberOfSteps &&
      this->Tolerance == other.Tolerance && this->Lookup == other.Lookup;
  }
};

// How an advection went.
struct FlowReport
{
  std::int64_t Redone = 0;      // particles that met an empty box or ended in an empty cell
  std::int64_t MovedToMass = 0; // those that no smaller step helped: put on the nearest mass
  std::int64_t Evaluations = 0; // velocity evaluations
};

} // namespace RectifiedTransport

#endif
