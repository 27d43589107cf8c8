// SPDX-License-Identifier: BSD-3-Clause
// Four doubles that behave as one scalar, so that a transform of one line transforms four, and
// complex numbers of them.
#ifndef RectifiedTransport_Lanes_h
#define RectifiedTransport_Lanes_h

#include <complex>

namespace RectifiedTransport
{

class Lanes
{
public:
  static constexpr int Count = 4;

  Lanes() = default;
  Lanes(double value) // NOLINT: arithmetic mixes both
    : A{ value, value }
    , B{ value, value }
  {
  }
  // Aligned to 16 bytes.
  static Lanes Load(const double* from)
  {
    const auto* pairs = reinterpret_cast<const Pair*>(from);
    return { pairs[0], pairs[1] };
  }

  Lanes& operator+=(const Lanes& other) { return *this = *this + other; }
  Lanes& operator-=(const Lanes& other) { return *this = *this - other; }
  Lanes& operator*=(const Lanes& other) { return *this = *this * other; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return { a.A + b.A, a.B + b.B }; }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return { a.A - b.A, a.B - b.B }; }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return { a.A * b.A, a.B * b.B }; }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return { a.A / b.A, a.B / b.B }; }
  friend Lanes operator-(const Lanes& a) { return { -a.A, -a.B }; }

private:
  // Every processor has registers of this size; longer vectors would be divided through memory, and
  // more of them would not fit in the registers.
  using Pair = double __attribute__((vector_size(16), may_alias));

  Lanes(Pair a, Pair b)
    : A(a)
    , B(b)
  {
  }

  Pair A;
  Pair B;
};

// Preferred to the standard library's, which may look for infinities.
inline std::complex<Lanes> operator*(const std::complex<Lanes>& a, const std::complex<Lanes>& b)
{
  return { a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real() };
}

} // namespace RectifiedTransport

#endif
