// SPDX-License-Identifier: BSD-3-Clause
// The one kernel source of equalizeAreas, compiled once per instruction set (EqualizeKernels*.cxx),
// by the same rules as FlowKernels.txx: internal linkage, and nothing of the standard library.
#include "Core/Equalize/Kernels/EqualizeKernels.h"

#define RT_INLINE inline __attribute__((always_inline))

namespace RectifiedTransport
{

namespace
{

struct Vector3
{
  float X;
  float Y;
  float Z;
};

// Point i of row a less point j of row b, subtracted in doubles.
RT_INLINE Vector3 difference(
  const PointRow<3>& a, std::int64_t i, const PointRow<3>& b, std::int64_t j)
{
  return { static_cast<float>(a.X[0][i] - b.X[0][j]), static_cast<float>(a.X[1][i] - b.X[1][j]),
    static_cast<float>(a.X[2][i] - b.X[2][j]) };
}

// The area vector of the bilinear face with these diagonals.
RT_INLINE Vector3 halfCross(const Vector3& a, const Vector3& b)
{
  return { 0.5F * (a.Y * b.Z - a.Z * b.Y), 0.5F * (a.Z * b.X - a.X * b.Z),
    0.5F * (a.X * b.Y - a.Y * b.X) };
}

RT_INLINE float squareOf(const Vector3& a)
{
  return a.X * a.X + a.Y * a.Y + a.Z * a.Z;
}

RT_INLINE Vector3 sumOfFour(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d)
{
  return { (a.X + b.X) + (c.X + d.X), (a.Y + b.Y) + (c.Y + d.Y), (a.Z + b.Z) + (c.Z + d.Z) };
}

#include "Core/Equalize/Kernels/CellAreas.txx"
#include "Core/Equalize/Kernels/CornerDisplacements.txx"

} // namespace

template <>
EqualizeKernels<2> equalizeKernelsOf<2, RECTIFIEDTRANSPORT_SET>()
{
  return { &rowAreas2D, &rowWeights2D, &rowMoves2D, &rowMultipliers2D, &rowProject2D };
}

template <>
EqualizeKernels<3> equalizeKernelsOf<3, RECTIFIEDTRANSPORT_SET>()
{
  return { &rowAreas3D, &rowWeights3D, &rowMoves3D, &rowMultipliers3D, &rowProject3D };
}

} // namespace RectifiedTransport
