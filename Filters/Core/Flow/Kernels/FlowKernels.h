// SPDX-License-Identifier: BSD-3-Clause
// The kernels that advect a block of particles (paper, Section 3.3), one set for each instruction
// set, and the choice among them.
#ifndef RectifiedTransport_FlowKernels_h
#define RectifiedTransport_FlowKernels_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Parallel/InstructionSet.h"
#include "Core/Tables/TableView.h"

#include <cstdint>

namespace RectifiedTransport
{

// Particles are advected in blocks of this many structure-of-arrays lanes.
constexpr int BlockSize = 64;

// Weights of one step of the graded Adams-Bashforth-Moulton method, the same for all particles.
// Times are in units of the graded interval: t = start + (1 - start) * Time.
struct StepWeights
{
  double Time;   // at the step's end
  double Length; // of the step
  double Predictor[3];
  double Corrector[3];
};

// Weights of step `step` of `steps`.
StepWeights multistepWeights(std::int64_t step, std::int64_t steps);

// The input and parameters that all blocks of one advection share.
template <int Dimension>
struct FlowJob
{
  TableView<Dimension> Tables;
  Integrator Method;
  bool Backward;
  bool Nearest;
  double Tolerance;
  std::int64_t Steps;
  const StepWeights* Weights;           // of Multistep with `Steps` steps, else null
  double CoarseRatio;                   // least width of a box in cells of the level that is used
  double* Output = nullptr;             // interleaved coordinates
  const double* Times = nullptr;        // dense output, ascending; null for the end point alone
  std::int64_t TimeCount = 1;           // 1 with the end point alone
  bool (*ShouldStop)(void* clientData); // polled every few steps, on any thread; null: never
  void* ClientData;
};

// Advects `count` <= BlockSize particles from `seeds` (interleaved) to the places `index` of the
// output, with 2^refinement times the steps (Adaptive: 4^-refinement times the tolerance). Sets
// unresolved[i] if particle i met an empty box or ended in an empty cell. Returns the number of
// velocity evaluations. Once ShouldStop returned true, positions are undefined.
template <int Dimension>
using AdvectBlock = std::int64_t (*)(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int refinement, bool* unresolved);

struct FlowKernels
{
  AdvectBlock<1> Advect1D;
  AdvectBlock<2> Advect2D;
  AdvectBlock<3> Advect3D;

  template <int Dimension>
  AdvectBlock<Dimension> Advect() const
  {
    if constexpr (Dimension == 1)
    {
      return this->Advect1D;
    }
    else if constexpr (Dimension == 2)
    {
      return this->Advect2D;
    }
    else
    {
      return this->Advect3D;
    }
  }
};

const FlowKernels& flowKernelsSSE2();
const FlowKernels& flowKernelsAVX2();
const FlowKernels& flowKernelsAVX512();

// All compute the same bits.
const FlowKernels& flowKernels(InstructionSet set = instructionSet());

} // namespace RectifiedTransport

#endif
