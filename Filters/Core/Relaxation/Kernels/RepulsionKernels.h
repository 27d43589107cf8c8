// SPDX-License-Identifier: BSD-3-Clause
// Sums of the Gaussian kernel of relaxByRepulsion, one set for each instruction set, and the choice
// among them.
#ifndef RectifiedTransport_RepulsionKernels_h
#define RectifiedTransport_RepulsionKernels_h

#include "Core/Geometry/Trees/BlockBounds.h"
#include "Core/Parallel/InstructionSet.h"

#include <cstdint>

namespace RectifiedTransport
{

// A mass with the spacing h of points at its place.
template <int Dimension>
struct ScaledPoint
{
  double X[Dimension];
  double Spacing;
  double Square; // Spacing^2
  double Mass;
};

// The kernel between points x and y with the spacings h and k,
//   K = (2 h k / (h^2 + k^2))^(D/2) g(|x - y|^2 / (2 s^2 (h^2 + k^2))),  g(q) = exp(-q),
// is the inner product of two Gaussians of unit norm and the standard deviations s h and s k, so
// that its sums are squared norms, whatever the spacings. g has compact support: from exp(-q) its
// tangent at `Cut` is subtracted, and it is 0 from there on.
struct RepulsionShape
{
  double PerVariance; // 1 / (2 s^2)
  double Cut;
  double AtCut; // exp(-Cut) of these kernels
};

// A multiple of every register's number of lanes: 2, 4 and 8.
constexpr int repulsionBlock = 8;

// As many points as the kernels take at once. Missing points are at 0 and have the Square
// -infinity, so that they are in reach of nothing.
template <int Dimension>
struct ScaledBlock
{
  double X[Dimension][repulsionBlock];
  double Spacing[repulsionBlock];
  double Square[repulsionBlock];
  double Mass[repulsionBlock];
};

// Places x, and for each the sum over points y of m K(x, y) with its derivatives.
template <int Dimension>
struct RepulsionBlock
{
  double X[Dimension][repulsionBlock];
  double Spacing[repulsionBlock];
  double Square[repulsionBlock];

  double Sum[repulsionBlock];
  double Gradient[Dimension][repulsionBlock]; // derivative with respect to x, at constant spacing
  double BySquare[repulsionBlock];            // derivative with respect to Square
};

template <int Dimension>
struct RepulsionKernels
{
  // Writes the numbers of those points of some blocks that are closer to the bounds than
  // sqrt(reach * (the sum of both squared spacings)), in their order; returns how many there are.
  // `found` has room for all points of these blocks.
  std::int64_t (*Select)(const BlockBounds<Dimension>& bounds, double reach,
    const ScaledBlock<Dimension>* points, const std::int64_t* blocks, std::int64_t count,
    std::int64_t* found);
  // Sums over the found points, in their order, at each place.
  void (*Sum)(const RepulsionShape& shape, const ScaledBlock<Dimension>* points,
    const std::int64_t* found, std::int64_t count, RepulsionBlock<Dimension>& block);
  double (*Exponential)(double); // exp(-q) for q in [0, 16]
};

// Compiled for each instruction set.
template <int Dimension, InstructionSet Set>
RepulsionKernels<Dimension> repulsionKernelsOf();

// The sets for all instruction sets compute the same bits.
template <int Dimension>
RepulsionKernels<Dimension> repulsionKernels(InstructionSet set = instructionSet());

} // namespace RectifiedTransport

#endif
