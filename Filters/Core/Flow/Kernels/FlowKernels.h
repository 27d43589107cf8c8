// SPDX-License-Identifier: BSD-3-Clause
// The range kernels that exist once per instruction set, and the choice among them.
#ifndef RectifiedTransport_FlowKernels_h
#define RectifiedTransport_FlowKernels_h

#include "Core/Flow/FlowOptions.h"
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

// What one pass finds in a row of cells. Sums are taken in eight lanes, in the same order for every
// instruction set.
struct RowInspection
{
  double Sum;
  double Moment; // about the low face of the first cell
  double Largest;
  double Smallest;
  std::int64_t Wrong; // values that are negative or not finite
};
using InspectRow = RowInspection (*)(const double* values, std::int64_t count);

// Adds a row of cells to {f, f * centre} of every column.
using AddToColumns = void (*)(
  const double* values, std::int64_t count, double centre, double* columns, double* moments);

// Adds one row of cells, or a strip of it, to the row of nodes below and writes the sums out.
// `Values` are the cells from the strip's start, `Prefix` the sums {f, f * centre along axis 0} of
// the row's cells before it. See TableBuild.cxx for the rest.
struct TableRow2D
{
  const double* Values;
  std::int64_t First; // first cell of the strip
  std::int64_t Count; // cells in the strip
  double Prefix[2];
  double Centre;       // along axis 1
  const double* Below; // the records of the strip's nodes First+1.. below this row of cells
  double* Nodes;       // where those above it go, not read
};
using AddTableRow2D = void (*)(const TableRow2D& row);

struct TableRow3D
{
  const double* Values;
  std::int64_t Count;  // cells in the row
  double Centre[2];    // along axes 1 and 2
  double* Columns;     // {f, f * centre 1} of each column of the slice so far, updated
  const double* Below; // the records of this row's nodes 1.. below this slice
  double* Nodes;       // where those above it go, not read
};
using AddTableRow3D = void (*)(const TableRow3D& row);

struct FlowKernels
{
  AdvectBlock<1> Advect1D;
  AdvectBlock<2> Advect2D;
  AdvectBlock<3> Advect3D;
  InspectRow Inspect;
  AddToColumns AddColumns;
  AddTableRow2D AddRow2D;
  AddTableRow3D AddRow3D;
  const char* InstructionSet;

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

// The widest that this processor runs; the environment variable RECTIFIEDTRANSPORT_ISA (SSE2, AVX2
// or AVX512) asks for a narrower one. All compute the same bits.
const FlowKernels& flowKernels();

} // namespace RectifiedTransport

#endif
