// SPDX-License-Identifier: BSD-3-Clause
// Sums of the repulsion of dots on a surface, one set for each instruction set, and the choice
// among them.
#ifndef RectifiedTransport_DotKernels_h
#define RectifiedTransport_DotKernels_h

#include "Core/Parallel/InstructionSet.h"

#include <cstdint>

namespace RectifiedTransport
{

// A dot at X. Of the spacing h that it is pushed with, Inverse is 1 / h and Root is sqrt(1 / h);
// Square is the square of the spacing of the density at its place, which may be noise.
struct ScaledDot
{
  double X[3];
  double Inverse;
  double Root;
  double Square;
};

// Dots with the spacings h and k at the distance d repel each other as q b^8 does, where
// b = 1 - q^2 / R^2 and q^2 = d^2 / (h k), up to the reach q = R: the gradient of a bump like a
// Gaussian, which is 0 from R on and takes three squarings.
constexpr double squaredDotReach = 2.5;

// Spacings are means over neighbours whose squares differ by at most this factor: others are across
// a jump of the density.
constexpr double mostOfSquares = 2.0;

constexpr int dotBlock = 8;

// The dots of some blocks, all of which have dotBlock dots, except the last of all blocks.
struct DotNeighbourhood
{
  const ScaledDot* Dots; // all
  std::int64_t NumberOfDots;
  const std::int64_t* Blocks;
  std::int64_t NumberOfBlocks;
};

// Places, and sums over dots y at each.
struct DotBlock
{
  double X[3][dotBlock];
  double Inverse[dotBlock];
  double Square[dotBlock];

  double Push[3][dotBlock]; // sum of (x - y) Root b^8
  double Weight[dotBlock];  // sum of b, over those with similar squares
  double Mean[dotBlock];    // sum of b Square, over the same
};

// Each place sums over the dots in their order.
using SumDots = void (*)(const DotNeighbourhood& inReach, DotBlock& block);

// The kernel; one specialization is compiled for each instruction set.
template <InstructionSet Set>
void sumDots(const DotNeighbourhood& inReach, DotBlock& block);

// All compute the same bits.
SumDots dotKernel(InstructionSet set = instructionSet());

} // namespace RectifiedTransport

#endif
