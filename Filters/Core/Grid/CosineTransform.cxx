// SPDX-License-Identifier: BSD-3-Clause
// Two real lines take one complex Fourier transform of length M (Press et al., "Numerical Recipes",
// cosft1).
#include "Core/Grid/CosineTransform.h"

namespace RectifiedTransport
{

// With y_j = (f_j + f_{M-j}) / 2 - sin(pi j / M) (f_j - f_{M-j}), the Fourier transform of y holds
// the even X in its real part and the differences of odd X in its imaginary part. Two real lines, a
// and b, are transformed as a + i b; the sums and differences of z_k and z_{M-k} separate them.
void CosineLines::Transform()
{
  const std::int64_t cells = this->Fourier.Length();
  const std::int64_t middle = cells / 2;
  ComplexLines* f = this->Line.data();
  ComplexLanes odd[2]; // half of X(1), which the recursion of the odd terms starts from
  for (int half = 0; half < 2; ++half)
  {
    odd[half] = 0.5 * (f[0][half] - f[cells][half]);
    f[0].Set(half, 0.5 * (f[0][half] + f[cells][half]));
  }
  for (std::int64_t j = 1; j < middle; ++j)
  {
    const ComplexLanes& root = this->Fourier.Roots()[j]; // cos(pi j / M) - i sin(pi j / M)
    for (int half = 0; half < 2; ++half)
    {
      const ComplexLanes sum = 0.5 * (f[j][half] + f[cells - j][half]);
      const ComplexLanes difference = f[j][half] - f[cells - j][half];
      const ComplexLanes turned = root.Imaginary * difference;
      odd[half] = odd[half] + root.Real * difference;
      f[j].Set(half, sum + turned);
      f[cells - j].Set(half, sum - turned);
    }
  }
  this->Fourier.Transform(f, this->Spectrum.data());
  const ComplexLines* z = this->Spectrum.data();
  for (int half = 0; half < 2; ++half)
  {
    // X(2 k + 1) = X(2 k - 1) + twice the sine sum at k.
    ComplexLanes last = 2.0 * odd[half];
    f[0].Set(half, 2.0 * z[0][half]);
    f[1].Set(half, last);
    for (std::int64_t k = 1; k < middle; ++k)
    {
      const ComplexLanes a = z[k][half];
      const ComplexLanes b = z[cells - k][half];
      f[2 * k].Set(half, a + b);
      last = last + ComplexLanes{ b.Imaginary - a.Imaginary, a.Real - b.Real };
      f[2 * k + 1].Set(half, last);
    }
    f[cells].Set(half, 2.0 * z[middle][half]);
  }
}

double CosineLines::MemoryFor(std::int64_t cells)
{
  constexpr double arrays = 3.0; // the line, its spectrum and the roots of unity
  return arrays * sizeof(ComplexLines) * static_cast<double>(cells + 1);
}

} // namespace RectifiedTransport
