// SPDX-License-Identifier: BSD-3-Clause
// The one kernel source of the dots' repulsion, compiled once per instruction set
// (DotKernels*.cxx), by the same rules as FlowKernels.txx: internal linkage, and nothing of the
// standard library.
#include "Surfaces/SurfaceRelaxation/Kernels/DotKernels.h"

#define RT_INLINE inline __attribute__((always_inline))

namespace RectifiedTransport
{

namespace
{

// Places are summed in whole registers, dots one after another: each place's sum has the same order
// for every width.
#if defined(__AVX512F__)
constexpr int lanes = 8;
#elif defined(__AVX__)
constexpr int lanes = 4;
#else
constexpr int lanes = 2;
#endif
// Sums that do not wait for each other.
constexpr int registers = dotBlock / lanes < 2 ? 1 : 2;

using Lanes = double __attribute__((vector_size(lanes * sizeof(double))));

RT_INLINE Lanes load(const double* from)
{
  Lanes v;
  __builtin_memcpy(&v, from, sizeof(v));
  return v;
}

RT_INLINE void store(const Lanes& v, double* to)
{
  __builtin_memcpy(to, &v, sizeof(v));
}

// Sums over all dots in reach for `registers` registers of places. For each dot y: d^2 = |x - y|^2,
// b = max(0, 1 - d^2 / (R^2 h k)), and the push (x - y) sqrt(1 / k) b^8; the factor of the place's
// own spacing is applied later. A dot pushes itself by 0.
RT_INLINE void sumLanes(const DotNeighbourhood& inReach, DotBlock& block, int lane)
{
  Lanes x[3][registers];
  Lanes push[3][registers];
  Lanes scale[registers];
  Lanes square[registers];
  Lanes weight[registers];
  Lanes mean[registers];
  for (int r = 0; r < registers; ++r)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis][r] = load(block.X[axis] + lane + r * lanes);
      push[axis][r] = Lanes{};
    }
    // 1 / (R^2 h), once for each place.
    scale[r] = load(block.Inverse + lane + r * lanes) * (1.0 / squaredDotReach);
    square[r] = load(block.Square + lane + r * lanes);
    weight[r] = Lanes{};
    mean[r] = Lanes{};
  }
  for (std::int64_t i = 0; i < inReach.NumberOfBlocks; ++i)
  {
    const std::int64_t first = inReach.Blocks[i] * dotBlock;
    const std::int64_t left = inReach.NumberOfDots - first;
    const ScaledDot* last = inReach.Dots + first + (left < dotBlock ? left : dotBlock);
    for (const ScaledDot* dot = inReach.Dots + first; dot < last; ++dot)
    {
      for (int r = 0; r < registers; ++r)
      {
        const Lanes a = x[0][r] - dot->X[0];
        const Lanes b = x[1][r] - dot->X[1];
        const Lanes c = x[2][r] - dot->X[2];
        const Lanes squared = a * a + b * b + c * c;
        Lanes bump = 1.0 - squared * (scale[r] * dot->Inverse);
        bump = bump > Lanes{} ? bump : Lanes{};
        const Lanes none = {};
        // The difference with zero lanes makes the dot's square a vector.
        const Lanes other = dot->Square - none;
        Lanes similar = other <= mostOfSquares * square[r] ? bump : none;
        similar = square[r] <= mostOfSquares * other ? similar : none;
        weight[r] += similar;
        mean[r] += similar * other;
        // b^8 by three squarings.
        bump *= bump;
        bump *= bump;
        bump *= bump;
        bump *= dot->Root;
        push[0][r] += a * bump;
        push[1][r] += b * bump;
        push[2][r] += c * bump;
      }
    }
  }
  for (int r = 0; r < registers; ++r)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      store(push[axis][r], block.Push[axis] + lane + r * lanes);
    }
    store(weight[r], block.Weight + lane + r * lanes);
    store(mean[r], block.Mean + lane + r * lanes);
  }
}

} // namespace

template <>
void sumDots<RECTIFIEDTRANSPORT_SET>(const DotNeighbourhood& inReach, DotBlock& block)
{
  for (int lane = 0; lane < dotBlock; lane += registers * lanes)
  {
    sumLanes(inReach, block, lane);
  }
}

} // namespace RectifiedTransport
