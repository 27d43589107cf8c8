// SPDX-License-Identifier: BSD-3-Clause
// The height of a triangle over its longest side.
#ifndef RectifiedTransport_FlatShape_h
#define RectifiedTransport_FlatShape_h

#include <cmath>

namespace RectifiedTransport
{

inline double squaredDistance(const double* a, const double* b)
{
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    sum += (b[i] - a[i]) * (b[i] - a[i]);
  }
  return sum;
}

struct FlatShape
{
  FlatShape(const double* a, const double* b, const double* c)
  {
    const double* corners[3] = { a, b, c };
    double square = -1.0;
    for (int i = 0; i < 3; ++i)
    {
      const double next = squaredDistance(corners[i], corners[(i + 1) % 3]);
      this->Longest = next > square ? i : this->Longest;
      square = next > square ? next : square;
    }
    this->Length = std::sqrt(square);
    double u[3];
    double v[3];
    for (int i = 0; i < 3; ++i)
    {
      u[i] = b[i] - a[i];
      v[i] = c[i] - a[i];
    }
    const double cross[3] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
      u[0] * v[1] - u[1] * v[0] };
    const double twiceArea =
      std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    this->Height = this->Length > 0.0 ? twiceArea / this->Length : 0.0;
  }

  int Longest = 0; // the side from this corner to the next
  double Length;   // its
  double Height;
};

} // namespace RectifiedTransport

#endif
