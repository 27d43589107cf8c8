// SPDX-License-Identifier: BSD-3-Clause
// The discrete cosine transform of the first kind of lines of nodes, eight at a time.
#ifndef RectifiedTransport_CosineTransform_h
#define RectifiedTransport_CosineTransform_h

#include "Core/Grid/FourierTransform.h"
#include "Core/Parallel/LargeBuffer.h"

#include <cstdint>

namespace RectifiedTransport
{

// X(k) = f(0) + (-1)^k f(M) + 2 sum over 0 < j < M of f(j) cos(pi j k / M), for lines of M + 1
// nodes and an even M. Twice it is 2 M times the identity. The same bits on every machine. For one
// thread at a time.
class CosineLines
{
public:
  static constexpr int Count = sizeof(ComplexLines) / sizeof(double);

  // M is the length of the Fourier transform, which has to outlive this object.
  explicit CosineLines(const FourierTransform& fourier)
    : Fourier(fourier)
    , Line(fourier.Length() + 1)
    , Spectrum(fourier.Length())
  {
  }

  // [node][line]. Real parts are lines 0 to 3, imaginary parts 4 to 7.
  double* Values() { return reinterpret_cast<double*>(this->Line.data()); }

  // Transforms the lines in place.
  void Transform();

  // Bytes for lines of so many cells.
  static double MemoryFor(std::int64_t cells);

private:
  const FourierTransform& Fourier;
  LargeBuffer<ComplexLines> Line;
  LargeBuffer<ComplexLines> Spectrum;
};

} // namespace RectifiedTransport

#endif
