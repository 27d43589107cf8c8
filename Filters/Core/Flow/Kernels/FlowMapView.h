// SPDX-License-Identifier: BSD-3-Clause
// A view of a flow map for kernels: plain pointers and numbers.
#ifndef RectifiedTransport_FlowMapView_h
#define RectifiedTransport_FlowMapView_h

#include <cstdint>

namespace RectifiedTransport
{

#include "Core/Flow/Kernels/Shared/FlowTypes.h"

struct StepWeights;

constexpr double commonStart = RT_COMMON_START;

// Steps of a lattice for each of its particles' steps: a lattice has few nodes, and its errors are
// those of all particles.
constexpr int latticeSteps = 2;

// Forwards, the steps of a node from the end of its straight start to two of the particles' steps
// before a hand-over.
constexpr std::int64_t startSteps(std::int64_t steps, int handOver)
{
  return latticeSteps * (steps - handOver - 2);
}

// Backwards, those of a node from one hand-over to another, or to time 0.
constexpr std::int64_t nodeSteps(std::int64_t from, std::int64_t to)
{
  return latticeSteps * (to - from) + 1;
}

// Nodes 0 ... Cells along one axis of a lattice on [0, Size]. They are evenly spaced in
//   u = 2 sqrt(Layer x) if x < Layer,   x + Layer inside,   and mirrored at the other end,
// which is denser towards both ends; evenly spaced in x if Layer is 0.
struct LatticeAxis
{
  double Size;
  double Layer;
  double Length; // the range of u: Size + 2 Layer
  double InverseSpacing;
  std::int64_t Cells;
};

// One lattice. Record: forwards the position at the time of HandOver, and the velocities there and
// at the two steps before, of the particle whose seed is the node; backwards the seed of the
// particle that is at the node at that time.
template <int Dimension>
struct FlowMapLevel
{
  // Floats a node: whole vector registers.
  static constexpr int ForwardRecord = Dimension == 3 ? 16 : 8;
  static constexpr int BackwardRecord = 4;

  int HandOver;   // steps of particles between it and time 1
  float TimeLeft; // until time 1
  LatticeAxis Axes[Dimension];
  float* Records;           // [node][record], axis 0 fastest; in cells, and cells a unit of time
  const unsigned char* Bad; // cells of the lattice that may not be interpolated: not 0
};

// The lattices, those with more steps to time 1 and wider spacings first.
template <int Dimension>
struct FlowMapView
{
  static constexpr int MaximumLevels = 16;

  FlowMapLevel<Dimension> Levels[MaximumLevels];
  int LevelCount = 0;
  // The steps, and their weights, that particles take from the hand-over.
  std::int64_t Steps;
  const StepWeights* Weights;
};

} // namespace RectifiedTransport

#endif
