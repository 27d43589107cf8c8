// SPDX-License-Identifier: BSD-3-Clause
// Two real lines take one complex Fourier transform of length M (Press et al., "Numerical Recipes",
// cosft1).
#include "Core/Grid/CosineTransform.h"

#include "Core/Geometry/ReproducibleMath.h"

#include <unsupported/Eigen/FFT>

#include <cstddef>

namespace RectifiedTransport
{

// Eigen's kissfft works on any scalar type: four lines in a Lanes are one scalar to it.
struct CosineLines::Plan : Eigen::internal::kiss_cpx_fft<Lanes>
{
};

// cos(pi j / M) and sin(pi j / M) for j up to M / 2 are all that cosft1 and the twiddles need.
CosineLines::CosineLines(std::int64_t cells)
  : Cells(cells)
  , Fourier(std::make_unique<Plan>())
  , Line(cells + 1)
  , Spectrum(cells)
{
  const auto half = static_cast<std::size_t>(cells / 2);
  this->Cosines.resize(half + 1);
  this->Sines.resize(half + 1);
  for (std::size_t j = 0; j <= half; ++j)
  {
    const auto [cosine, sine] = cosineAndSine(static_cast<std::int64_t>(j), 2 * cells);
    this->Cosines[j] = cosine;
    this->Sines[j] = sine;
  }
  // The twiddles exp(-2 pi i j / M), set here: Eigen would take the cosines of the standard
  // library, whose bits vary.
  Plan& plan = *this->Fourier;
  plan.m_inverse = false;
  plan.m_twiddles.resize(2 * half);
  for (std::size_t j = 0; j <= half; ++j)
  {
    const bool second = 2 * j > half;
    const std::size_t at = second ? 2 * (half - j) : 2 * j;
    const double cosine = second ? -this->Cosines[at] : this->Cosines[at];
    plan.m_twiddles[j] = Complex(cosine, -this->Sines[at]);
    if (j > 0)
    {
      plan.m_twiddles[2 * half - j] = Complex(cosine, this->Sines[at]);
    }
  }
  plan.factorize(static_cast<int>(cells));
}

CosineLines::~CosineLines() = default;

// With y_j = (f_j + f_{M-j}) / 2 - sin(pi j / M) (f_j - f_{M-j}), the Fourier transform of y holds
// the even X in its real part and the differences of odd X in its imaginary part. Two real lines, a
// and b, are transformed as a + i b; the sums and differences of z_k and z_{M-k} separate them.
void CosineLines::Transform()
{
  const std::int64_t cells = this->Cells;
  const std::int64_t middle = cells / 2;
  Complex* f = this->Line.data();
  // Half of X(1), which the recursion of the odd terms starts from.
  Complex odd = Lanes(0.5) * (f[0] - f[cells]);
  f[0] = Lanes(0.5) * (f[0] + f[cells]);
  for (std::int64_t j = 1; j < middle; ++j)
  {
    const Complex sum = Lanes(0.5) * (f[j] + f[cells - j]);
    const Complex difference = f[j] - f[cells - j];
    const Complex turned = Lanes(this->Sines[static_cast<std::size_t>(j)]) * difference;
    odd += Lanes(this->Cosines[static_cast<std::size_t>(j)]) * difference;
    f[j] = sum - turned;
    f[cells - j] = sum + turned;
  }
  this->Fourier->work(0, this->Spectrum.data(), f, 1, 1);
  const Complex* z = this->Spectrum.data();
  // X(2 k + 1) = X(2 k - 1) + twice the sine sum at k.
  Complex last = Lanes(2.0) * odd;
  f[0] = Lanes(2.0) * z[0];
  f[1] = last;
  for (std::int64_t k = 1; k < middle; ++k)
  {
    const Complex a = z[k];
    const Complex b = z[cells - k];
    f[2 * k] = Complex(a.real() + b.real(), a.imag() + b.imag());
    last += Complex(b.imag() - a.imag(), a.real() - b.real());
    f[2 * k + 1] = last;
  }
  f[cells] = Lanes(2.0) * z[middle];
}

double CosineLines::MemoryFor(std::int64_t cells)
{
  // The line, its spectrum and the plan's twiddles; cosines and sines.
  return (3.0 * sizeof(Complex) + sizeof(double)) * static_cast<double>(cells + 2);
}

} // namespace RectifiedTransport
