// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/ExactSum.h"

#include <cmath>
#include <cstddef>
#include <cstring>

namespace RectifiedTransport
{

namespace
{

// A double is mantissa * 2^(exponent), with the lowest bit at 2^-1074 for subnormal numbers.
constexpr int mantissaBits = 52;
constexpr int lowestExponent = -1074;
// Parts of terms are below 2^33, so that 2^30 of them fit a signed word of 64 bits; then carries
// are due.
constexpr std::int64_t mostTerms = std::int64_t{ 1 } << 30;

} // namespace

// Adds the term's 53 bits at their place in a fixed-point number that spans all doubles (Kulisch's
// accumulator). Nothing is rounded, so that sums do not depend on the order of the terms.
void ExactSum::Add(double term)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &term, sizeof(bits));
  const auto exponent = static_cast<int>(bits >> mantissaBits & 0x7ff);
  // Infinities and NaN are summed as doubles: what their sum is does not depend on the order.
  if (exponent == 0x7ff)
  {
    this->NotFinite += term;
    return;
  }
  constexpr std::uint64_t implicit = std::uint64_t{ 1 } << mantissaBits;
  const std::uint64_t mantissa = (bits & (implicit - 1)) | (exponent > 0 ? implicit : 0);
  const int place = exponent > 0 ? exponent - 1 : 0; // place of the mantissa's lowest bit
  const auto word = static_cast<std::size_t>(place / WordBits);
  const int shift = place % WordBits;
  constexpr std::uint64_t mask = 0xffffffff;
  const std::uint64_t low = (mantissa & mask) << shift;
  const std::uint64_t high = (mantissa >> WordBits) << shift;
  const std::int64_t parts[3] = { static_cast<std::int64_t>(low & mask),
    static_cast<std::int64_t>((low >> WordBits) + (high & mask)),
    static_cast<std::int64_t>(high >> WordBits) };
  // Negates the parts without a branch: x ^ -1 = -x - 1.
  const std::int64_t sign = static_cast<std::int64_t>(bits) >> 63; // 0 or -1
  for (std::size_t i = 0; i < 3; ++i)
  {
    this->Word[word + i] += (parts[i] ^ sign) - sign;
  }
  if (++this->Terms == mostTerms)
  {
    this->Carry();
  }
}

// Adds two sums; both are carried first, so that words do not overflow.
void ExactSum::Add(const ExactSum& other)
{
  ExactSum carried = other;
  carried.Carry();
  this->Carry();
  for (std::size_t i = 0; i < Words; ++i)
  {
    this->Word[i] += carried.Word[i];
  }
  this->NotFinite += other.NotFinite;
  this->Terms = 1;
}

// Carries what exceeds 32 bits of each word into the next one. Afterwards all words but the last
// are from 0 to 2^32 - 1; the last one has the sign.
void ExactSum::Carry()
{
  for (std::size_t i = 0; i + 1 < Words; ++i)
  {
    const std::int64_t carry = this->Word[i] >> WordBits; // rounded down
    this->Word[i] -= carry * (std::int64_t{ 1 } << WordBits);
    this->Word[i + 1] += carry;
  }
  this->Terms = 0;
}

// The double nearest to the exact sum.
double ExactSum::Value() const
{
  if (this->NotFinite != 0.0)
  {
    return this->NotFinite;
  }
  ExactSum rest = *this;
  rest.Carry();
  // The magnitude of a negative sum: its words negated and carried again.
  const bool isNegative = rest.Word.back() < 0;
  if (isNegative)
  {
    for (std::int64_t& word : rest.Word)
    {
      word = -word;
    }
    rest.Carry();
  }
  auto top = static_cast<int>(Words) - 1;
  while (top > 0 && rest.Word[static_cast<std::size_t>(top)] == 0)
  {
    --top;
  }
  // The 64 bits of the sum from its highest one on are rounded to a double once. Their lowest bit
  // is set if anything below is not 0 (a sticky bit), so that ties are those of the exact sum.
  const auto wordAt = [&rest](int word) {
    return word < 0 ? std::uint64_t{ 0 }
                    : static_cast<std::uint64_t>(rest.Word[static_cast<std::size_t>(word)]);
  };
  std::uint64_t value = wordAt(top) << WordBits | wordAt(top - 1);
  int exponent = lowestExponent + WordBits * (top - 1);
  std::uint64_t below = wordAt(top - 2);
  for (; value != 0 && value >> 63 == 0; --exponent)
  {
    value = value << 1 | (below >> (WordBits - 1) & 1);
    below = (below << 1) & 0xffffffff;
  }
  bool isExact = below == 0;
  for (int word = top - 3; word >= 0 && isExact; --word)
  {
    isExact = wordAt(word) == 0;
  }
  value |= isExact ? 0 : 1;
  const double rounded = std::ldexp(static_cast<double>(value), exponent);
  return isNegative ? -rounded : rounded;
}

} // namespace RectifiedTransport
