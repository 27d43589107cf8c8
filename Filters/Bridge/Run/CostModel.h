// SPDX-License-Identifier: BSD-3-Clause
// Estimated times of parts of the work. They divide progress among the stages of a run.
#ifndef RectifiedTransport_CostModel_h
#define RectifiedTransport_CostModel_h

#include "Core/Flow/FlowOptions.h"

namespace RectifiedTransport::Bridge
{

// Nanoseconds, as measured on one thread.
namespace Cost
{

constexpr double Seed = 20.0;          // a seed
constexpr double Write = 50.0;         // a particle with its arrays
constexpr double MassShare = 150.0;    // a sample in 3D, with its other arrays
constexpr double MeanAndSplat = 60.0;  // a particle of a blend
constexpr double Comparison = 4000.0;  // a particle and a density
constexpr double Relaxation = 20000.0; // a point, in each iteration
constexpr double InvertedCell = 200.0; // a vtkCell, to find whether it turned over
constexpr double Reading = 2.0;        // a cell's value
constexpr double OptimalCell = 1500.0; // a cell of an optimal map

// The cost of moving one particle.
inline double flow(const FlowOptions& options, int dimension)
{
  const double evaluation = dimension == 3 ? 60.0 : 15.0;
  constexpr int usual = 64; // that 0 stands for
  return evaluation * (options.NumberOfSteps > 0 ? options.NumberOfSteps : usual) *
    (options.Integrator == Integrator::RungeKutta4 ? 4.0 : 1.0);
}

// The cost of the correction of areas for each cell of the density: the flow of its corners, and
// the passes.
inline double equalization(const FlowOptions& options, int dimension)
{
  const double passes = dimension == 3 ? 1500.0 : 500.0;
  return flow(options, dimension) + passes;
}

} // namespace Cost

} // namespace RectifiedTransport::Bridge

#endif
