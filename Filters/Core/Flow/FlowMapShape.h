// SPDX-License-Identifier: BSD-3-Clause
// Which lattices a flow map has: they follow from the grid, the number of steps and the direction
// alone. Documentation/Flow.md gives the formulas.
#ifndef RectifiedTransport_FlowMapShape_h
#define RectifiedTransport_FlowMapShape_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/GridSize.h"

#include <cstdint>
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
    GridSize<Dimension> Cells; // of the lattice, between its nodes
    Point<Dimension> Layers;   // see LatticeAxis
    double Cost;               // in velocity evaluations of particles
  };

  // Empty if lattices do not serve: in 1D, for few steps, for so many that records of float
  // precision are too coarse, and where there would be more than one node for four cells. With a
  // refinement particles take 2^refinement times as many steps on lattices of the same accuracy. No
  // lattice hands over later than `leastHandOver` steps before time 1.
  FlowMapShape(const GridSize<Dimension>& size, int numberOfSteps, FlowDirection direction,
    int refinement = 0, int leastHandOver = 1);

  double MemorySize() const; // bytes of the map

  // Whether particles take less time with the map, that of making it included.
  bool PaysFor(double particles) const;

  int NumberOfSteps; // of particles without a map
  int Steps;         // of particles that hand over: fewer, as the lattices' are finer
  FlowDirection Direction;
  std::vector<Level> Levels; // wider spacings first
  // In cells, along each axis: cells of a lattice that deviate more from cubics are bad.
  Point<Dimension> Deviation{};
  double Cost = 0.0; // of all levels
};

// Forwards, 1 - t at the hand-over that leaves so many of the steps; backwards as well.
double timeLeft(FlowDirection direction, int handOver, int steps);
// Whether boxes are so wide at a hand-over that nothing may be handed over before it.
bool isAfterStart(FlowDirection direction, int handOver, int steps);

// Whether the method of the options can start from flow maps.
inline bool takesFlowMaps(const FlowOptions& options)
{
  return options.Integrator == Integrator::Multistep && options.Lookup == TableLookup::Interpolated;
}

// Options, which must be valid, with Auto replaced by what it means for so many particles, On or
// Off; as they are where no map serves.
template <int Dimension>
FlowOptions withFlowMaps(
  FlowOptions options, const GridSize<Dimension>& size, FlowDirection direction, double particles);

} // namespace RectifiedTransport

#endif
