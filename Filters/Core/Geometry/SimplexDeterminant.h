// SPDX-License-Identifier: BSD-3-Clause
// The signed measure of a simplex.
#ifndef RectifiedTransport_SimplexDeterminant_h
#define RectifiedTransport_SimplexDeterminant_h

#include "Core/Geometry/Points.h"

#include <array>
#include <cstddef>

namespace RectifiedTransport
{

// D! times the signed measure of a simplex: the determinant of its edge vectors from vertex 0.
inline double determinant(const std::array<Point<1>, 2>& v)
{
  return v[1][0] - v[0][0];
}

inline double determinant(const std::array<Point<2>, 3>& v)
{
  return (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[1][1] - v[0][1]) * (v[2][0] - v[0][0]);
}

inline double determinant(const std::array<Point<3>, 4>& v)
{
  double e[3][3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      // Rows are edge vectors; det = e_0 . (e_1 x e_2).
      e[i][a] = v[i + 1][a] - v[0][a];
    }
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
    e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

// D! simplices of equal measure make up a box.
template <int D>
constexpr double simplicesOfBox = D == 3 ? 6.0 : D;

} // namespace RectifiedTransport

#endif
