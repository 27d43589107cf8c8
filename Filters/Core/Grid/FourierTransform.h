// SPDX-License-Identifier: BSD-3-Clause
// The discrete Fourier transform of any length, with mixed radices (Cooley and Tukey, "An Algorithm
// for the Machine Calculation of Complex Fourier Series", 1965).
#ifndef RectifiedTransport_FourierTransform_h
#define RectifiedTransport_FourierTransform_h

#include "Core/Geometry/ReproducibleMath.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Every processor has registers of this size; longer vectors would be divided through memory.
using Lanes = double __attribute__((vector_size(16), may_alias));

// std::complex is for scalars, and its products may look for infinities.
struct ComplexLanes
{
  Lanes Real;
  Lanes Imaginary;
};

inline ComplexLanes operator+(const ComplexLanes& a, const ComplexLanes& b)
{
  return { a.Real + b.Real, a.Imaginary + b.Imaginary };
}
inline ComplexLanes operator-(const ComplexLanes& a, const ComplexLanes& b)
{
  return { a.Real - b.Real, a.Imaginary - b.Imaginary };
}
inline ComplexLanes operator*(const ComplexLanes& a, const ComplexLanes& b)
{
  return { a.Real * b.Real - a.Imaginary * b.Imaginary,
    a.Real * b.Imaginary + a.Imaginary * b.Real };
}
template <class Scalar> // Lanes or double
inline ComplexLanes operator*(const Scalar& a, const ComplexLanes& b)
{
  return { a * b.Real, a * b.Imaginary };
}
inline ComplexLanes timesI(const ComplexLanes& a)
{
  return { -a.Imaginary, a.Real };
}

// A complex number of each of four lines, read and written by halves: one half's intermediate
// values fit in the registers.
struct ComplexLines
{
  ComplexLanes operator[](int half) const { return { this->Real[half], this->Imaginary[half] }; }
  void Set(int half, const ComplexLanes& value)
  {
    this->Real[half] = value.Real;
    this->Imaginary[half] = value.Imaginary;
  }

  Lanes Real[2];
  Lanes Imaginary[2];
};

// X(k) = sum over j of x(j) exp(-2 pi i j k / n), of four complex lines of n >= 2 values at a time.
// The same bits on every machine.
class FourierTransform
{
public:
  // The radices are 4 as often as possible, as it takes the fewest operations, then 2 and the odd
  // primes.
  explicit FourierTransform(std::int64_t length)
    : Size(length)
  {
    for (std::int64_t j = 0; j < 2 * length; ++j)
    {
      // Mirrored, so that eighths of a turn, too, have the same bits in all quarters.
      const std::int64_t folded = std::min(j, 2 * length - j);
      const auto [cosine, sine] = cosineAndSine(std::min(folded, length - folded), 2 * length);
      const double real = 2 * folded > length ? -cosine : cosine;
      const double imaginary = j < length ? -sine : sine;
      this->RootsOfUnity.push_back({ Lanes{ real, real }, Lanes{ imaginary, imaginary } });
    }
    std::size_t radix = 4;
    for (auto part = static_cast<std::size_t>(length); part > 1;)
    {
      while (part % radix != 0)
      {
        radix = radix == 4 ? 2 : radix == 2 ? 3 : radix + 2;
        radix = radix * radix > part ? part : radix; // a part without smaller factors is prime
      }
      part /= radix;
      this->Stages.push_back({ radix, part });
    }
  }

  std::int64_t Length() const { return this->Size; }
  // exp(-pi i j / n) for j below 2 n.
  const ComplexLanes* Roots() const { return this->RootsOfUnity.data(); }
  // The arrays have n values and do not overlap.
  void Transform(const ComplexLines* from, ComplexLines* to) const { this->Run(0, from, 1, to); }

private:
  struct Stage
  {
    std::size_t Radix; // p
    std::size_t Part;  // m, the length of the transforms that it combines
  };

  // The transform of p m values at this stride: those of p sequences of every p-th value, combined.
  void Run(std::size_t stage, const ComplexLines* from, std::size_t stride, ComplexLines* to) const
  {
    const auto [radix, part] = this->Stages[stage];
    std::size_t step = stride;
    if (part > 1)
    {
      for (std::size_t q = 0; q < radix; ++q)
      {
        this->Run(stage + 1, from + q * stride, stride * radix, to + q * part);
      }
      from = to;
      step = part;
    }
    switch (radix)
    {
      case 2:
        return this->Combine<2>(from, step, part, stride, to);
      case 3:
        return this->Combine<3>(from, step, part, stride, to);
      case 4:
        return this->Combine<4>(from, step, part, stride, to);
      case 5:
        return this->Combine<5>(from, step, part, stride, to);
      default:
        return this->CombineBySums(radix, from, step, part, stride, to);
    }
  }

  // x(k + r m) = sum over q of z(q) exp(-2 pi i q r / p) with z(q) = w^(q k) x(k + q m), where w is
  // the first root of unity of order p m.
  template <std::size_t Radix>
  void Combine(const ComplexLines* from, std::size_t step, std::size_t part, std::size_t stride,
    ComplexLines* to) const
  {
    for (std::size_t k = 0; k < part; ++k)
    {
      for (int half = 0; half < 2; ++half)
      {
        std::array<ComplexLanes, Radix> z;
        z[0] = from[k][half];
        for (std::size_t q = 1; q < Radix; ++q)
        {
          z[q] = from[k + q * step][half] * this->RootsOfUnity[2 * q * k * stride];
        }
        z = this->Sums(z);
        for (std::size_t q = 0; q < Radix; ++q)
        {
          to[k + q * part].Set(half, z[q]);
        }
      }
    }
  }

  // The same with the sums as they are written.
  void CombineBySums(std::size_t radix, const ComplexLines* from, std::size_t step,
    std::size_t part, std::size_t stride, ComplexLines* to) const
  {
    std::vector<ComplexLines> z(radix);
    for (std::size_t k = 0; k < part; ++k)
    {
      for (std::size_t q = 0; q < radix; ++q)
      {
        z[q] = from[k + q * step];
      }
      for (std::size_t r = k; r < radix * part; r += part)
      {
        ComplexLines sum = z[0];
        for (std::size_t q = 1, turn = 0; q < radix; ++q)
        {
          turn += 2 * r * stride;
          turn -= turn < this->RootsOfUnity.size() ? 0 : this->RootsOfUnity.size();
          for (int half = 0; half < 2; ++half)
          {
            sum.Set(half, sum[half] + z[q][half] * this->RootsOfUnity[turn]);
          }
        }
        to[r] = sum;
      }
    }
  }

  // The transforms of 2 to 5 values, in which conjugate roots share sums and differences.
  std::array<ComplexLanes, 2> Sums(const std::array<ComplexLanes, 2>& z) const
  {
    return { z[0] + z[1], z[0] - z[1] };
  }
  std::array<ComplexLanes, 3> Sums(const std::array<ComplexLanes, 3>& z) const
  {
    const Lanes sine = this->RootsOfUnity[this->RootsOfUnity.size() / 3].Imaginary;
    const ComplexLanes sum = z[1] + z[2];
    const ComplexLanes even = z[0] - 0.5 * sum;
    const ComplexLanes odd = timesI(sine * (z[1] - z[2]));
    return { z[0] + sum, even + odd, even - odd };
  }
  std::array<ComplexLanes, 4> Sums(const std::array<ComplexLanes, 4>& z) const
  {
    const ComplexLanes sum = z[0] + z[2];
    const ComplexLanes even = z[0] - z[2];
    const ComplexLanes others = z[1] + z[3];
    const ComplexLanes odd = timesI(z[1] - z[3]);
    return { sum + others, even - odd, sum - others, even + odd };
  }
  std::array<ComplexLanes, 5> Sums(const std::array<ComplexLanes, 5>& z) const
  {
    const ComplexLanes& first = this->RootsOfUnity[this->RootsOfUnity.size() / 5];
    const ComplexLanes& second = this->RootsOfUnity[this->RootsOfUnity.size() / 5 * 2];
    const ComplexLanes sum1 = z[1] + z[4];
    const ComplexLanes sum2 = z[2] + z[3];
    const ComplexLanes difference1 = z[1] - z[4];
    const ComplexLanes difference2 = z[2] - z[3];
    const ComplexLanes even1 = z[0] + (first.Real * sum1 + second.Real * sum2);
    const ComplexLanes even2 = z[0] + (second.Real * sum1 + first.Real * sum2);
    const ComplexLanes odd1 =
      timesI(first.Imaginary * difference1 + second.Imaginary * difference2);
    const ComplexLanes odd2 =
      timesI(second.Imaginary * difference1 - first.Imaginary * difference2);
    return { z[0] + sum1 + sum2, even1 + odd1, even2 + odd2, even2 - odd2, even1 - odd1 };
  }

  std::int64_t Size; // n
  std::vector<ComplexLanes> RootsOfUnity;
  std::vector<Stage> Stages;
};

} // namespace RectifiedTransport

#endif
