// SPDX-License-Identifier: BSD-3-Clause
// The one kernel source of the repulsion, compiled once per instruction set
// (RepulsionKernels*.cxx), by the same rules as FlowKernels.txx: internal linkage, and nothing of
// the standard library.
#include "Core/Relaxation/Kernels/RepulsionKernels.h"

#define RT_INLINE inline __attribute__((always_inline))

namespace RectifiedTransport
{

namespace
{

// The lanes of a register are places; the points y follow one after another. The sum at a place
// then has the same order for every width of registers.
#if defined(__AVX512F__)
constexpr int lanes = 8;
#elif defined(__AVX__)
constexpr int lanes = 4;
#else
constexpr int lanes = 2;
#endif

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

// Returns the minimum, lane by lane, and b where a is NaN.
RT_INLINE Lanes lesser(const Lanes& a, double b)
{
  const Lanes all = b - Lanes{};
  return a < all ? a : all;
}

RT_INLINE double lesser(double a, double b)
{
  return a < b ? a : b;
}

RT_INLINE double squareRoot(double a)
{
  return __builtin_sqrt(a);
}

// Roots are rounded correctly by IEEE 754, so that all instruction sets give the same bits.
RT_INLINE Lanes squareRoot(const Lanes& a)
{
  Lanes root;
  for (int i = 0; i < lanes; ++i)
  {
    root[i] = __builtin_sqrt(a[i]);
  }
  return root;
}

// exp(-q) for q in [0, 16], to 2e-10 of it: the 32nd power of the polynomial that is exp(-q / 32)
// at the Chebyshev points of t = 1/4 - q / 32, which is within 1/4.
template <class Value>
RT_INLINE Value exponential(const Value& q)
{
  const Value t = 0.25 - q * 0.03125;
  Value p = t * 0.00015479244535331668 + 0.00108408449795983;
  p = p * t + 0.006489996035544878;
  p = p * t + 0.03244993819606626;
  p = p * t + 0.129800130643039;
  p = p * t + 0.3894003927162396;
  p = p * t + 0.7788007830711488;
  p = p * t + 0.7788007830690991;
  p *= p;
  p *= p;
  p *= p;
  p *= p;
  p *= p;
  return p;
}

template <int Dimension>
std::int64_t selectPoints(const BlockBounds<Dimension>& bounds, double reach,
  const ScaledBlock<Dimension>* points, const std::int64_t* blocks, std::int64_t count,
  std::int64_t* found)
{
  std::int64_t selected = 0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const ScaledBlock<Dimension>& block = points[blocks[i]];
    std::int64_t isInReach[repulsionBlock]; // -1 or 0
    for (int lane = 0; lane < repulsionBlock; lane += lanes)
    {
      Lanes squared = {};
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const Lanes x = load(block.X[axis] + lane);
        const Lanes below = bounds.Low[axis] - x;
        const Lanes above = x - bounds.High[axis];
        Lanes gap = above > below ? above : below;
        gap = gap > Lanes{} ? gap : Lanes{};
        squared += gap * gap;
      }
      // A mask of -1 or 0 for each lane.
      const auto are = squared < reach * (load(block.Square + lane) + bounds.Largest);
      __builtin_memcpy(isInReach + lane, &are, sizeof(are));
    }
    for (int lane = 0; lane < repulsionBlock; ++lane)
    {
      // Branch-free: the number is always written, and the end advances only if it is in reach. The
      // outcome is unpredictable, so that a branch would cost a misprediction each.
      found[selected] = blocks[i] * repulsionBlock + lane;
      selected -= isInReach[lane];
    }
  }
  return selected;
}

// The sums of one register of places x, over all points y of mass m and spacing k. With r = 1 /
// (h^2 + k^2), K = A g(q) where A = (2 h k r)^(D/2) and q = |x - y|^2 r / (2 s^2), so that
//   dK/dx      = -g'(q) A r (y - x) / s^2,
//   dK/d(h^2)  = -g'(q) A r q + g(q) A (D/4 / h^2 - D/2 r).
// g(q) = exp(-q) less its tangent at Cut, for q up to Cut, where it is 0 with its derivative.
// Offsets are in the units of the points, masses in theirs.
template <int Dimension>
RT_INLINE void sumLanes(const RepulsionShape& shape, const ScaledBlock<Dimension>* points,
  const std::int64_t* found, std::int64_t count, RepulsionBlock<Dimension>& block, int lane)
{
  Lanes x[Dimension];
  Lanes gradient[Dimension];
  for (int axis = 0; axis < Dimension; ++axis)
  {
    x[axis] = load(block.X[axis] + lane);
    gradient[axis] = Lanes{};
  }
  const Lanes twice = 2.0 * load(block.Spacing + lane);
  const Lanes square = load(block.Square + lane);
  Lanes sum = {};
  Lanes bySquare = {};
  for (const std::int64_t* number = found; number < found + count; ++number)
  {
    const ScaledBlock<Dimension>& from = points[*number / repulsionBlock];
    const std::int64_t at = *number % repulsionBlock;
    Lanes offset[Dimension]; // y - x
    Lanes squared = {};
    for (int axis = 0; axis < Dimension; ++axis)
    {
      offset[axis] = from.X[axis][at] - x[axis];
      squared += offset[axis] * offset[axis];
    }
    const Lanes inverse = 1.0 / (square + from.Square[at]);
    const Lanes q = lesser(squared * inverse * shape.PerVariance, shape.Cut);
    Lanes overlap = twice * from.Spacing[at] * inverse; // m A
    if constexpr (Dimension == 3)
    {
      overlap *= squareRoot(overlap);
    }
    overlap *= from.Mass[at];
    const Lanes e = exponential(q);
    const Lanes g = e - shape.AtCut * ((1.0 + shape.Cut) - q);
    const Lanes slope = (e - shape.AtCut) * inverse * overlap; // -g' A m r
    sum += overlap * g;
    bySquare += slope * q - (0.5 * Dimension) * (overlap * inverse * g);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      gradient[axis] += slope * offset[axis];
    }
  }
  // These factors are common to all points, so they are applied once. In the derivative with
  // respect to h^2, the term with D/4 / h^2 multiplies the sum itself.
  store(sum, block.Sum + lane);
  store(bySquare + (0.25 * Dimension) * sum / square, block.BySquare + lane);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    store(gradient[axis] * (2.0 * shape.PerVariance), block.Gradient[axis] + lane);
  }
}

// The places of a block, a register at a time.
template <int Dimension>
void sumBlock(const RepulsionShape& shape, const ScaledBlock<Dimension>* points,
  const std::int64_t* found, std::int64_t count, RepulsionBlock<Dimension>& block)
{
  for (int lane = 0; lane < repulsionBlock; lane += lanes)
  {
    sumLanes<Dimension>(shape, points, found, count, block, lane);
  }
}

double exponentialOf(double q)
{
  return exponential(q);
}

} // namespace

template <>
RepulsionKernels<2> repulsionKernelsOf<2, RECTIFIEDTRANSPORT_SET>()
{
  return { &selectPoints<2>, &sumBlock<2>, &exponentialOf };
}

template <>
RepulsionKernels<3> repulsionKernelsOf<3, RECTIFIEDTRANSPORT_SET>()
{
  return { &selectPoints<3>, &sumBlock<3>, &exponentialOf };
}

} // namespace RectifiedTransport
