// SPDX-License-Identifier: BSD-3-Clause
// The Fourier transform against its definition.
#include "Core/Grid/FourierTransform.h"

#include "Core/Parallel/LargeBuffer.h"

#include <gtest/gtest.h>

#include <complex>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t numbers = sizeof(ComplexLines) / sizeof(double);
constexpr std::int64_t lines = numbers / 2;

// exp(-2 pi i part / whole).
std::complex<double> rootOfUnity(std::int64_t part, std::int64_t whole)
{
  const auto [cosine, sine] = cosineAndSine(part % whole, whole);
  return { cosine, -sine };
}

double* valuesOf(LargeBuffer<ComplexLines>& buffer)
{
  return reinterpret_cast<double*>(buffer.data());
}

std::complex<double> valueAt(const double* values, std::int64_t j, std::int64_t line)
{
  return { values[j * numbers + line], values[j * numbers + lines + line] };
}

// All radices, once and several times: 2, 3, 4, 5, and primes with a sum of their own.
TEST(FourierTransform, IsTheSumOfItsDefinition)
{
  for (const std::int64_t length : { 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 15, 16, 20, 25, 26, 27, 30,
         32, 49, 60, 77, 120, 121, 210 })
  {
    LargeBuffer<ComplexLines> from(length);
    LargeBuffer<ComplexLines> to(length);
    for (std::int64_t i = 0; i < numbers * length; ++i)
    {
      valuesOf(from)[i] = unitReal(randomWord(1, static_cast<std::uint64_t>(i))) - 0.5;
    }
    FourierTransform(length).Transform(from.data(), to.data());
    for (std::int64_t k = 0; k < length; ++k)
    {
      for (std::int64_t line = 0; line < lines; ++line)
      {
        std::complex<double> sum;
        for (std::int64_t j = 0; j < length; ++j)
        {
          sum += valueAt(valuesOf(from), j, line) * rootOfUnity(j * k, length);
        }
        ASSERT_NEAR(std::abs(sum - valueAt(valuesOf(to), k, line)), 0.0, 1e-13) << length;
      }
    }
  }
}

TEST(FourierTransform, RootsAreMirrored)
{
  for (const std::int64_t length : { 2, 6, 8, 20 })
  {
    const FourierTransform transform(length);
    for (std::int64_t j = 1; j < 2 * length; ++j)
    {
      const ComplexLanes& root = transform.Roots()[j];
      const ComplexLanes& mirrored = transform.Roots()[2 * length - j];
      EXPECT_EQ(root.Real[0], mirrored.Real[0]);
      EXPECT_EQ(root.Imaginary[0], -mirrored.Imaginary[0]);
      EXPECT_NEAR(std::abs(rootOfUnity(j, 2 * length) -
                    std::complex<double>(root.Real[1], root.Imaginary[1])),
        0.0, 2e-16);
    }
  }
}

} // namespace
} // namespace RectifiedTransport
