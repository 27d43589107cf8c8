// SPDX-License-Identifier: BSD-3-Clause
// The longest side of a triangle and the height over it: twice the area by the side.
#ifndef RectifiedTransport_TriangleShape_h
#define RectifiedTransport_TriangleShape_h

#include "Core/Geometry/Vectors.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

struct TriangleShape
{
  TriangleShape(const Point<3>& a, const Point<3>& b, const Point<3>& c)
  {
    const double squares[3] = { squaredDistance(a, b), squaredDistance(b, c),
      squaredDistance(c, a) };
    this->Longest = static_cast<int>(std::max_element(squares, squares + 3) - squares);
    this->Length = std::sqrt(squares[this->Longest]);
    const Point<3> normal = cross(b - a, c - a);
    this->Height = this->Length > 0.0 ? std::sqrt(dot(normal, normal)) / this->Length : 0.0;
  }

  int Longest;   // the side from this corner to the next
  double Length; // length of the longest side
  double Height; // height over the longest side, in the same unit
};

} // namespace RectifiedTransport

#endif
