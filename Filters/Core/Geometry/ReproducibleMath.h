// SPDX-License-Identifier: BSD-3-Clause
// Random numbers, roots, exponentials, cosines and sines with the same bits on every machine and in
// every standard library.
#ifndef RectifiedTransport_ReproducibleMath_h
#define RectifiedTransport_ReproducibleMath_h

#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

// The output function of SplitMix64 (Steele, Lea and Flood 2014).
inline std::uint64_t mixBits(std::uint64_t z)
{
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

// Word `counter` of the stream `seed`, by random access.
inline std::uint64_t randomWord(std::uint64_t seed, std::uint64_t counter)
{
  constexpr std::uint64_t increment = 0x9E3779B97F4A7C15u;
  return mixBits(mixBits(seed + increment) + (counter + 1) * increment);
}

// A word as a fraction in [0, 1).
inline double unitReal(std::uint64_t word)
{
  return static_cast<double>(word >> 11) * 0x1p-53;
}

// By Newton's iteration y <- (2 y + m / y^2) / 3 on a mantissa in [1/2, 4), whose exponent is a
// multiple of 3. From 1, eight steps reach double precision.
inline double cubeRoot(double x)
{
  if (!(x > 0.0))
  {
    return 0.0;
  }
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  for (; exponent % 3 != 0; --exponent)
  {
    mantissa *= 2.0;
  }
  double y = 1.0;
  for (int iteration = 0; iteration < 8; ++iteration)
  {
    y = (2.0 * y + mantissa / (y * y)) / 3.0;
  }
  return std::ldexp(y, exponent / 3);
}

// e^x to rounding, for |x| up to 700: e^x = 2^k e^r with x = k log 2 + r, |r| <= log(2) / 2, and
// e^r by its series in Horner's form. log 2 is split in two, so that k times its first part is
// exact.
inline double exponential(double x)
{
  constexpr double logOfTwo = 0x1.62e42fefap-1; // its first bits, whose multiples are exact
  constexpr double more = 0x1.cf79abc9e3b3ap-40;
  constexpr int terms = 14; // r^14 / 14! is below the rounding
  const double power = std::round(x / logOfTwo);
  const double rest = (x - power * logOfTwo) - power * more;
  double sum = 1.0;
  for (int term = terms; term > 0; --term)
  {
    sum = 1.0 + rest / term * sum;
  }
  return std::ldexp(sum, static_cast<int>(power));
}

// The natural logarithm of a positive number: log(2^k m) = k log 2 + log m.
inline double naturalLogarithm(double x)
{
  constexpr double logOfTwo = 0.693147180559945309417;
  int power = 0;
  const double mantissa = std::frexp(x, &power);
  double y = 0.0; // log m, by Halley's iteration y + 2 (m - e^y) / (m + e^y)
  for (int iteration = 0; iteration < 4; ++iteration)
  {
    const double found = exponential(y);
    y += 2.0 * (mantissa - found) / (mantissa + found);
  }
  return power * logOfTwo + y;
}

struct CosineAndSine
{
  double Cosine;
  double Sine;
};

// The cosine and sine of a part of a full turn, to rounding. Part and whole are at most 2^59, the
// whole is positive. Angles that differ by symmetry have values that differ by symmetry: the
// series of both are evaluated within an eighth of a turn.
inline CosineAndSine cosineAndSine(std::int64_t part, std::int64_t whole)
{
  constexpr double quarterTurn = 1.57079632679489661923;
  constexpr int terms = 18; // powers up to this one; the angle is at most pi / 4
  // The nearest number of quarter turns, and the rest, at most half of one, which is exact.
  std::int64_t rest = 4 * (part % whole);
  const std::int64_t half = rest < 0 ? -whole / 2 : whole / 2;
  const std::int64_t quarters = (rest + half) / whole;
  rest -= quarters * whole;
  const double angle = quarterTurn * (static_cast<double>(rest) / static_cast<double>(whole));
  const double square = angle * angle;
  double cosine = 1.0;
  double sine = 1.0;
  for (int term = terms; term > 0; term -= 2)
  {
    cosine = 1.0 - square / (term * (term - 1)) * cosine;
    sine = 1.0 - square / (term * (term + 1)) * sine;
  }
  sine *= angle;
  switch (quarters & 3)
  {
    case 0:
      return { cosine, sine };
    case 1:
      return { -sine, cosine };
    case 2:
      return { -cosine, -sine };
    default:
      return { sine, -cosine };
  }
}

template <int Degree>
double root(double x)
{
  static_assert(Degree >= 1 && Degree <= 3, "no such root");
  return Degree == 1 ? x : Degree == 2 ? std::sqrt(x) : cubeRoot(x);
}

} // namespace RectifiedTransport

#endif
