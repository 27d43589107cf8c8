// SPDX-License-Identifier: BSD-3-Clause
// The one kernel source of FaceSystem, loops of conjugate gradients and Jacobi's iteration,
// compiled once per instruction set (FaceKernels*.cxx), by the same rules as FlowKernels.txx:
// internal linkage, and nothing of the standard library.
#include "Core/Grid/Kernels/FaceKernels.h"

#define RT_INLINE inline __attribute__((always_inline))

namespace RectifiedTransport
{

namespace
{

// Sums are taken in lanes, in the same order for every instruction set.
constexpr int sumLanes = 16;

// The sum of the lanes, in their order.
RT_INLINE double addLanes(const double (&lanes)[sumLanes])
{
  double sum = 0.0;
  for (int lane = 0; lane < sumLanes; ++lane)
  {
    sum += lanes[lane];
  }
  return sum;
}

// The sum of term(i), i in [first, last): lane l adds the terms with (i - first) % 16 = l.
template <class Term>
RT_INLINE double sumOf(std::int64_t first, std::int64_t last, const Term& term)
{
  alignas(64) double lanes[sumLanes] = {};
  // Whole groups of lanes are vectors; the rest adds to the first lanes.
  const std::int64_t whole = first + (last - first) / sumLanes * sumLanes;
  for (std::int64_t i = first; i < whole; i += sumLanes)
  {
#pragma omp simd
    for (int lane = 0; lane < sumLanes; ++lane)
    {
      lanes[lane] += static_cast<double>(term(i + lane));
    }
  }
  for (std::int64_t i = whole; i < last; ++i)
  {
    lanes[i - whole] += static_cast<double>(term(i));
  }
  return addLanes(lanes);
}

// Minus (A x)_q = sum over neighbours r of w_qr (x_r - x_q). Differences are taken in the type of
// x, before they are rounded to floats.
template <int Dimension, class Value>
RT_INLINE float inflow(const FaceWeights<Dimension>& system, const Value* x, std::int64_t q)
{
  float sum = 0.0F;
#pragma GCC unroll 3
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const float* w = system.Weights[axis];
    const std::int64_t s = system.Stride[axis];
    sum +=
      w[q] * static_cast<float>(x[q + s] - x[q]) + w[q - s] * static_cast<float>(x[q - s] - x[q]);
  }
  return sum;
}

// output = b - A x, stored from index 0 on.
template <int Dimension>
void residual(const FaceWeights<Dimension>& given, const float* x, const float* b,
  std::int64_t first, std::int64_t last, float* __restrict output)
{
  const FaceWeights<Dimension> system = given;
#pragma omp simd
  for (std::int64_t q = first; q < last; ++q)
  {
    output[q - first] = b[q] + inflow<Dimension>(system, x, q);
  }
}

// output = x + factor D^-1 (b - A x), a damped Jacobi step.
template <int Dimension>
void relax(const FaceWeights<Dimension>& given, const float* x, const float* b, float factor,
  std::int64_t first, std::int64_t last, float* __restrict output)
{
  const FaceWeights<Dimension> system = given;
  // From x = 0 the residual is b.
  if (!x)
  {
#pragma omp simd
    for (std::int64_t q = first; q < last; ++q)
    {
      output[q] = factor * (system.Inverse[q] * b[q]);
    }
    return;
  }
#pragma omp simd
  for (std::int64_t q = first; q < last; ++q)
  {
    output[q] = x[q] + factor * (system.Inverse[q] * (b[q] + inflow<Dimension>(system, x, q)));
  }
}

// output = A x; returns x . A x, the curvature of conjugate gradients.
template <int Dimension>
double apply(const FaceWeights<Dimension>& given, const float* x, std::int64_t first,
  std::int64_t last, float* __restrict output)
{
  const FaceWeights<Dimension> system = given;
  return sumOf(first, last, [&](std::int64_t q) {
    const float value = -inflow<Dimension>(system, x, q);
    output[q] = value;
    return x[q] * value;
  });
}

// r = b - A x with x in double precision; returns |r|^2.
template <int Dimension>
double trueResidual(const FaceWeights<Dimension>& given, const double* x, const float* b,
  std::int64_t first, std::int64_t last, float* __restrict r)
{
  const FaceWeights<Dimension> system = given;
  return sumOf(first, last, [&](std::int64_t q) {
    const float value = b[q] + inflow<Dimension>(system, x, q);
    r[q] = value;
    return value * value;
  });
}

// The sum of a_i b_i, with products in single precision and sums in double precision.
double dot(const float* a, const float* b, std::int64_t first, std::int64_t last)
{
  return sumOf(first, last, [&](std::int64_t q) { return a[q] * b[q]; });
}

// x += alpha p in double precision, r -= alpha q; returns |r|^2.
double advance(float factor, const float* p, const float* q, std::int64_t first, std::int64_t last,
  double* __restrict x, float* __restrict r)
{
  return sumOf(first, last, [&](std::int64_t i) {
    x[i] += static_cast<double>(factor) * static_cast<double>(p[i]);
    const float value = r[i] - factor * q[i];
    r[i] = value;
    return value * value;
  });
}

// p = z + beta p.
void newDirection(
  float beta, const float* z, std::int64_t first, std::int64_t last, float* __restrict p)
{
#pragma omp simd
  for (std::int64_t i = first; i < last; ++i)
  {
    p[i] = z[i] + beta * p[i];
  }
}

} // namespace

template <>
FaceKernels<2> faceKernelsOf<2, RECTIFIEDTRANSPORT_SET>()
{
  return { &residual<2>, &relax<2>, &apply<2>, &trueResidual<2>, &dot, &advance, &newDirection };
}

template <>
FaceKernels<3> faceKernelsOf<3, RECTIFIEDTRANSPORT_SET>()
{
  return { &residual<3>, &relax<3>, &apply<3>, &trueResidual<3>, &dot, &advance, &newDirection };
}

} // namespace RectifiedTransport
