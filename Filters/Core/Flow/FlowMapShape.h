// SPDX-License-Identifier: BSD-3-Clause
// Which lattices a flow map has. They depend only on the grid, the number of steps and the
// direction. FlowMapShape.cxx has the formulas.
#ifndef RectifiedTransport_FlowMapShape_h
#define RectifiedTransport_FlowMapShape_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/GridSize.h"

#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
struct FlowMapShape
{
  struct Level
  {
    int HandOver;              // steps of particles between it and time 1
    double TimeLeft;           // until time 1
    GridSize<Dimension> Cells; // cells of the lattice, between its nodes
    Point<Dimension> Layers;   // see LatticeAxis
    double Cost;               // in velocity evaluations of particles
  };

  // Empty if lattices are no use: in 1D, for few steps, for so many steps that float precision is
  // too coarse, and if there were more than one node for four cells. With a refinement, particles
  // take 2^refinement times as many steps, on lattices of the same accuracy. No lattice hands over
  // later than `leastHandOver` steps before time 1. Lattices are as exact as `mapSteps` steps; 0:
  // as numberOfSteps.
  FlowMapShape(const GridSize<Dimension>& size, int numberOfSteps, FlowDirection direction,
    int refinement = 0, int leastHandOver = 1, int mapSteps = 0);

  double MemorySize() const; // bytes of the map

  // Whether particles take less time with the map, including the time to make it.
  bool PaysFor(double particles) const;
  // The cost with the map, in velocity evaluations, including those to make it, if it does not
  // serve this share of the particles (`bad`). There are levels.
  double CostWith(double particles, double bad) const;

  int NumberOfSteps; // the steps of particles without a map
  int MapSteps;
  int Steps; // the steps of particles that hand over: fewer, as the lattices' are finer
  FlowDirection Direction;
  std::vector<Level> Levels; // wider spacings first
  // In cells, along each axis: lattice cells that deviate more from cubics are bad.
  Point<Dimension> Deviation{};
  double Cost = 0.0; // the sum over all levels

private:
  double Saved() const; // evaluations of a particle in a good cell
};

// Evaluations of a particle without a map.
double velocitiesOf(FlowDirection direction, int numberOfSteps);

// 1 - t at the hand-over that leaves this many of the steps, forward or backward.
double timeLeft(FlowDirection direction, int handOver, int steps);
// Whether boxes at a hand-over are so wide that no hand-over may come before it.
bool isAfterStart(FlowDirection direction, int handOver, int steps);

// Whether the method of the options can start from flow maps.
inline bool takesFlowMaps(const FlowOptions& options)
{
  return options.Integrator == Integrator::Multistep && options.Lookup == TableLookup::Interpolated;
}

// Valid options with Auto replaced by On or Off for this number of particles; unchanged if no map
// is possible.
template <int Dimension>
FlowOptions withFlowMaps(
  FlowOptions options, const GridSize<Dimension>& size, FlowDirection direction, double particles);

} // namespace RectifiedTransport

#endif
