// SPDX-License-Identifier: BSD-3-Clause
// The kernels that advect a block of particles (paper, Section 3.3), one set for each instruction
// set, and the choice among them.
#ifndef RectifiedTransport_FlowKernels_h
#define RectifiedTransport_FlowKernels_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/Kernels/FlowMapView.h"
#include "Core/Parallel/InstructionSet.h"
#include "Core/Tables/TableView.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Particles are advected in blocks of this many structure-of-arrays lanes.
constexpr int BlockSize = 64;

// Weights of one step of the graded Adams-Bashforth-Moulton method, the same for all particles.
// Times are in units of the graded interval: t = start + (1 - start) * Time.
struct StepWeights
{
  double Time;         // at the step's end
  double Length;       // the step's length
  double Predictor[3]; // for the velocities at the step's start and the two steps before
  double Corrector[3]; // for the velocities at the step's end, its start and the step before
};

// sin^2(pi/2 * step / steps) from basic operations alone: the library's sine may differ in the
// last bit from one processor to the next.
double grading(std::int64_t step, std::int64_t steps);

// The predictor of a step that has three velocities behind it.
enum class Predictor
{
  Adams, // Adams-Bashforth 3
  Stiff  // the line through the newest velocity and the one two steps before
};

// That of a step that ends so long before time 1. Backwards the velocity contracts, at up to half
// the ratio of densities next to each other on a face of the box, and Stiff is stable for steps
// four times as long as Adams: 1.2 over the rate against .29. The corrector is the same and makes
// the pair one of order 3. Near time 0 boxes are wide, and Adams is more exact.
Predictor predictorFor(FlowDirection direction, double timeLeft);

// Weights of step `step` of `steps`.
StepWeights multistepWeights(
  std::int64_t step, std::int64_t steps, Predictor predictor = Predictor::Adams);

// Those of all steps of a run from one end of time to the other.
std::vector<StepWeights> multistepWeightsOf(std::int64_t steps, FlowDirection direction);

// Weights of step `step` of the first `count` of `steps`, stretched to end at time 1.
StepWeights stretchedWeights(std::int64_t step, std::int64_t count, std::int64_t steps,
  Predictor predictor = Predictor::Adams);

// The input and parameters that all blocks of one advection share.
template <int Dimension>
struct FlowJob
{
  TableView<Dimension> Tables;
  RectifiedTransport::Integrator Integrator;
  bool Backward;              // from time 1 to 0: from the density to the uniform measure
  bool Nearest;               // boxes are rounded to whole cells (Section 4.3), not interpolated
  bool Sparse = false;        // neighbouring particles have few table nodes in common
  double Tolerance;           // of Adaptive: the error of a step, in cells
  std::int64_t Steps;         // N, of pass 0
  const StepWeights* Weights; // for Multistep with `Steps` steps, else null
  double CoarseRatio;         // least width of a box in cells of the level that is used
  const FlowMapView<Dimension>* Map = nullptr; // with the same steps and direction; Multistep only
  // Forwards, passes before 0 take particles from their states at the hand-over, which are given in
  // place of their seeds: position and the last three velocities, 4 * Dimension numbers a particle.
  bool FromStates = false;
  // Backwards, particles stop at the finest level of the map: those that it gives no seed (none
  // does without records) are unresolved, and their output is where they are at the hand-over.
  bool StopsAtMap = false;
  double* Output = nullptr;      // [particle][TimeCount][Dimension], in cells
  const double* Times = nullptr; // dense output, ascending; null for the end point alone
  std::int64_t TimeCount = 1;    // 1 with the end point alone
  // Polled every few steps, on any thread; null: never.
  bool (*ShouldStop)(void* clientData) = nullptr;
  void* ClientData = nullptr;
};

// Advects `count` <= BlockSize particles from `seeds` (interleaved) to the places `index` of the
// output. Pass 0 takes Steps steps, pass p > 0 takes 2^p times as many (Adaptive: 4^-p times the
// tolerance); forwards, pass -1 - l starts from level l of the map, and all times must lie after
// its hand-over; backwards, it may leave particles there. Sets unresolved[i] if particle i met an
// empty box, ended in an empty cell, may not be interpolated, or was left. Returns the number of
// velocity evaluations. Once ShouldStop returned true, positions are undefined.
template <int Dimension>
using AdvectBlock = std::int64_t (*)(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int pass, bool* unresolved);

// Nodes of a lattice, at most BlockSize.
struct NodeBlock
{
  const double* Places; // interleaved coordinates
  const std::int64_t* Index;
  int Count;
  const StepWeights* Weights; // forwards from scratch of startSteps, backwards of nodeSteps
  unsigned char* Deferred;    // a node of the block
  unsigned char* Unresolved;  // a node of the lattice
};

// Makes the records of nodes of a level from those of the level `parent` of the job's map, which is
// coarser; -1: from scratch. Sets Deferred to 1 where the parent may not be interpolated: that node
// has no record then. Sets Troubled[Index[i]] to 1 for nodes that met an empty box, else to 0.
// Returns the number of velocity evaluations.
template <int Dimension>
using AdvanceNodes = std::int64_t (*)(const FlowJob<Dimension>& job,
  const FlowMapLevel<Dimension>& level, int parent, const NodeBlock& block);

// Writes where the particles of at most BlockSize seeds are at the time of a level. Sets
// deferred[i] where its lattice may not be interpolated: that position is not written.
template <int Dimension>
using ReadMap = void (*)(const FlowJob<Dimension>& job, const FlowMapLevel<Dimension>& level,
  const double* seeds, int count, double* positions, bool* deferred);

template <int Dimension>
struct FlowKernels
{
  AdvectBlock<Dimension> Advect;
  AdvanceNodes<Dimension> Advance;
  ReadMap<Dimension> Read;
};

// Compiled for each instruction set.
template <int Dimension, InstructionSet Set>
FlowKernels<Dimension> flowKernelsOf();

// All compute the same bits.
template <int Dimension>
FlowKernels<Dimension> flowKernels(InstructionSet set = instructionSet());

} // namespace RectifiedTransport

#endif
