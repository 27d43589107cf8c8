// SPDX-License-Identifier: BSD-3-Clause
// Poisson's equation on the cells of a grid, with a weight at each face:
//   sum over the faces of q: w (x_q - x_r) = b_q, no flux at the border,
// by conjugate gradients, preconditioned by a multigrid V-cycle.
#ifndef RectifiedTransport_FaceSystem_h
#define RectifiedTransport_FaceSystem_h

#include "Core/Geometry/GridSize.h"
#include "Core/Grid/Kernels/FaceKernels.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Values of the cells of a grid, axis 0 fastest. Zeros lie before and after them, so that
// neighbours beyond the border may be read.
template <int Dimension, class Value = float>
class CellArray
{
public:
  CellArray() = default;
  explicit CellArray(const GridSize<Dimension>& size);
  Value* data() { return this->Values.data() + this->Margin; }
  const Value* data() const { return this->Values.data() + this->Margin; }

private:
  std::int64_t Margin = 0;
  LargeBuffer<Value> Values;
};

// What a solution took and how good it is: |b - A x| / |b|.
struct FaceSolution
{
  int Iterations = 0;
  double Residual = 0.0; // relative to the right-hand side
};

// The solver and its levels. It holds float arrays; the solution alone is in double precision.
template <int Dimension>
class FaceSystem
{
public:
  explicit FaceSystem(const GridSize<Dimension>& size);

  // To be written before Prepare: the weights of the cells' upper faces along an axis, 0 at the
  // border, and the right-hand side, whose sum is zero. Solve overwrites the latter.
  float* Weights(int axis) { return this->Levels.front().Weights[axis].data(); }
  float* RightHandSide() { return this->Levels.front().Right.data(); }
  // Makes the coarser levels. Units of progress: twice the cells.
  void Prepare(Progress& progress);
  // Iterates until the residual is within the tolerance, relative to the right-hand side, or the
  // solution hardly changes any more.
  FaceSolution Solve(double tolerance, int maximum, Progress& progress);
  const double* Solution() const { return this->Found.data(); }

  // Bytes that an object takes.
  static double Memory(const GridSize<Dimension>& size);

private:
  // A level of the multigrid: Weights of the upper faces along each axis, the inverse diagonal, the
  // right-hand side, x, and the array that a Jacobi step writes. All have one value a cell.
  struct Level
  {
    GridSize<Dimension> Size;
    std::int64_t Cells;
    std::int64_t Stride[Dimension];
    CellArray<Dimension> Weights[Dimension];
    CellArray<Dimension> Inverse;
    CellArray<Dimension> Right;
    CellArray<Dimension> X;
    CellArray<Dimension> Other;

    explicit Level(const GridSize<Dimension>& size);
    FaceWeights<Dimension> View() const;
  };

  // Runs a kernel on cells [0, cells) by the progress's threads, or on this thread if the level is
  // small.
  void For(std::int64_t cells, RangeKernel kernel, Progress& progress) const;
  void ForRows(const Level& coarse, RangeKernel kernel, Progress& progress) const;
  void Invert(Level& level, Progress& progress);
  void Coarsen(const Level& fine, Level& coarse, Progress& progress);
  void Restrict(const Level& fine, Level& coarse, Progress& progress);
  void Prolong(const Level& coarse, Level& fine, Progress& progress);
  void Cycle(std::size_t at, Progress& progress);
  void RelaxOnce(Level& level, bool fromZero, double factor, Progress& progress);
  void Relax(Level& level, bool fromZero, Progress& progress);
  void RelaxBack(Level& level, Progress& progress);

  FaceKernels<Dimension> Kernels;
  std::vector<Level> Levels;
  CellArray<Dimension> Given; // the right-hand side
  // In doubles, as differences of neighbours are far smaller than values.
  CellArray<Dimension, double> Found;
  CellArray<Dimension> Search;
};

} // namespace RectifiedTransport

#endif
