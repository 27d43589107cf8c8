// SPDX-License-Identifier: BSD-3-Clause
// The range kernels of an advection, which exist once per instruction set, and the choice among
// them.
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

// One advection: everything that its blocks share.
template <int Dimension>
struct FlowJob
{
  TableView<Dimension> Tables;
  Integrator Method;
  bool Backward;
  bool Nearest;
  double Tolerance;
  std::int64_t Steps;
  const StepWeights* Weights;     // of Multistep with `Steps` steps, else null
  double CoarseRatio;             // a level is used while the box is this many of its cells wide
  double* Output;                 // interleaved coordinates
  const double* Times;            // dense output, ascending; null for the end point alone
  std::int64_t TimeCount;         // 1 with the end point alone
  bool (*ShouldStop)(void* host); // asked now and then, on any thread; null: never
  void* Host;
};

// Advects `count` <= BlockSize particles from `seeds` (interleaved) to the places `index` of the
// output, with 2^refinement times the steps (or the tolerance lowered accordingly). Sets
// troubled[i] if particle i met an empty box or ended in an empty cell. Returns the number of
// velocity evaluations. Once the host wants to stop, positions are undefined.
template <int Dimension>
using AdvectBlock = std::int64_t (*)(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int refinement, bool* troubled);

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
