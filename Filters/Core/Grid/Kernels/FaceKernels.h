// SPDX-License-Identifier: BSD-3-Clause
// The loops of FaceSystem over cells, one set for each instruction set, and the choice among them.
#ifndef RectifiedTransport_FaceKernels_h
#define RectifiedTransport_FaceKernels_h

#include "Core/Parallel/InstructionSet.h"

#include <cstdint>

namespace RectifiedTransport
{

// Cells of a grid, flat, and the weights of their upper faces along each axis; 0 at the border.
// Arrays may be read as far before and after the cells as the largest stride.
template <int Dimension>
struct FaceWeights
{
  const float* Weights[Dimension];
  std::int64_t Stride[Dimension];
  const float* Inverse; // 1 / the sum of the weights of a cell's faces
};

template <int Dimension>
struct FaceKernels
{
  // For cells [first, last) of a system A x = b with (A x)_q = sum over faces w (x_q - x_r):
  // output = b - A x
  void (*Residual)(const FaceWeights<Dimension>& system, const float* x, const float* b,
    std::int64_t first, std::int64_t last, float* output);
  // output = x + factor * (b - A x) / diagonal; x null: x = 0
  void (*Relax)(const FaceWeights<Dimension>& system, const float* x, const float* b, float factor,
    std::int64_t first, std::int64_t last, float* output);
  // output = A x; returns the sum of x * output.
  double (*Apply)(const FaceWeights<Dimension>& system, const float* x, std::int64_t first,
    std::int64_t last, float* output);
  // r = b - A x; returns the sum of r^2.
  double (*TrueResidual)(const FaceWeights<Dimension>& system, const double* x, const float* b,
    std::int64_t first, std::int64_t last, float* r);
  // Returns the sum of a * b.
  double (*Dot)(const float* a, const float* b, std::int64_t first, std::int64_t last);
  // x += factor * p, r -= factor * q; returns the sum of r^2.
  double (*Advance)(float factor, const float* p, const float* q, std::int64_t first,
    std::int64_t last, double* x, float* r);
  // p = z + beta * p
  void (*NewDirection)(float beta, const float* z, std::int64_t first, std::int64_t last, float* p);
};

// Compiled for each instruction set.
template <int Dimension, InstructionSet Set>
FaceKernels<Dimension> faceKernelsOf();

// All compute the same bits.
template <int Dimension>
FaceKernels<Dimension> faceKernels(InstructionSet set = instructionSet());

} // namespace RectifiedTransport

#endif
