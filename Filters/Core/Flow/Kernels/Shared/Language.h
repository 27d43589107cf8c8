// SPDX-License-Identifier: BSD-3-Clause
// What the shared kernels are written in: the part that C++ and OpenCL C 1.2 have in common, and
// these names for what differs. In C++ it is included by FlowKernels.txx, within its namespaces and
// after Vectors.txx; for devices it is the first part of the program (FlowPrograms.h).
#ifndef RectifiedTransport_Language_h
#define RectifiedTransport_Language_h

#ifdef __cplusplus

using Int64 = std::int64_t;
using Int32 = std::int32_t;
using Bits64 = std::uint64_t;
using Byte = unsigned char;
using Real4 = Vector4;
using Real8 = Vector8;
using Float4 = Vector<4, float>;

#define RT_FUNCTION RT_INLINE
#define RT_GLOBAL
#define RT_CONSTANT

#define RT_ENTRY(vector, k) ((vector)[k])
#define RT_LOAD8(from) loadVector<8>(from)
#define RT_LOAD_FLOATS(from) loadVector<4>(from)
#define RT_ZERO4 fillVector(0.0)
#define RT_FILL4(value) fillVector(value)
#define RT_VECTOR4(a, b, c, d) makeVector((a), (b), (c), (d))
// Four times a value, but another one in one place.
#define RT_FILL4_BUT(place, value, other) fillVector<place>((value), (other))
#define RT_JOIN(first, second) joinVectors((first), (second))
#define RT_ADD_HALVES(vector) addHalves(vector)

// Rounds values from 0 to 2^31 down.
RT_FUNCTION double truncated(double value)
{
#if defined(__SSE4_1__)
  return __builtin_floor(value);
#else
  return static_cast<double>(static_cast<std::int32_t>(value));
#endif
}

RT_FUNCTION double rootOf(double value)
{
  return __builtin_sqrt(value);
}

RT_FUNCTION Bits64 bitsOf(double value)
{
  Bits64 bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

RT_FUNCTION double fromBits(Bits64 bits)
{
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

#else

// Products and sums are rounded one after the other, as on processors.
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#ifndef RT_WITH_CONTRACTION
#pragma OPENCL FP_CONTRACT OFF
#endif

typedef long Int64;
typedef int Int32;
typedef ulong Bits64;
typedef uchar Byte;
typedef double4 Real4;
typedef double8 Real8;
typedef float4 Float4;

#define RT_FUNCTION
#define RT_GLOBAL __global
#define RT_CONSTANT __constant

#define RT_ENTRY(vector, k) ((vector).s##k)
// Records lie at multiples of their size, so that whole ones are read at once.
#define RT_RECORD(from) (*(__global const double4*)(from))
#define RT_LOAD8(from) ((double8)(RT_RECORD(from), RT_RECORD((from) + 4)))
#define RT_LOAD_FLOATS(from) (*(__global const float4*)(from))
#define RT_ZERO4 ((double4)(0.0))
#define RT_FILL4(value) ((double4)(value))
#define RT_VECTOR4(a, b, c, d) ((double4)((a), (b), (c), (d)))
#define RT_FILL4_BUT(place, value, other) RT_FILL4_BUT_##place(value, other)
#define RT_FILL4_BUT_1(value, other) ((double4)((value), (other), (value), (value)))
#define RT_FILL4_BUT_2(value, other) ((double4)((value), (value), (other), (value)))
#define RT_FILL4_BUT_3(value, other) ((double4)((value), (value), (value), (other)))
#define RT_JOIN(first, second) ((double8)((first), (second)))
#define RT_ADD_HALVES(vector) ((vector).lo + (vector).hi)

double truncated(double value)
{
  return floor(value);
}

double rootOf(double value)
{
  return sqrt(value);
}

Bits64 bitsOf(double value)
{
  return as_ulong(value);
}

double fromBits(Bits64 bits)
{
  return as_double(bits);
}

#endif

RT_FUNCTION double smaller(double a, double b)
{
  return a < b ? a : b;
}

RT_FUNCTION double larger(double a, double b)
{
  return a > b ? a : b;
}

#endif
