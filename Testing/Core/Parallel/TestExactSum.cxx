// SPDX-License-Identifier: BSD-3-Clause
// Exact sums: rounded once, and the same bits whatever the order of the terms.
#include "Core/Parallel/ExactSum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

using Limits = std::numeric_limits<double>;

double sumOf(const std::vector<double>& terms)
{
  ExactSum sum;
  for (const double term : terms)
  {
    sum.Add(term);
  }
  return sum.Value();
}

// Of all signs and sizes.
std::vector<double> mixedTerms()
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  std::uniform_int_distribution<int> exponent(-1060, 1000);
  std::vector<double> terms(5000);
  for (double& term : terms)
  {
    term = std::ldexp(mantissa(random), exponent(random));
  }
  return terms;
}

TEST(ExactSum, SmallTermsBesideLargeOnes)
{
  EXPECT_EQ(sumOf({}), 0.0);
  EXPECT_EQ(sumOf({ 1e300, 1.0, -1e300 }), 1.0);
  EXPECT_EQ(sumOf({ 1e300, Limits::denorm_min(), -1e300 }), Limits::denorm_min());
  EXPECT_EQ(sumOf({ -3.0, 1.0 }), -2.0);
  EXPECT_EQ(sumOf({ 5.0, -5.0 }), 0.0);
  EXPECT_EQ(sumOf({ Limits::max(), Limits::max(), -Limits::max() }), Limits::max());
  EXPECT_EQ(sumOf({ Limits::max(), Limits::max() }), Limits::infinity());
  EXPECT_EQ(sumOf({ Limits::denorm_min(), Limits::denorm_min() }), 2.0 * Limits::denorm_min());
  EXPECT_EQ(sumOf({ Limits::min(), -Limits::denorm_min() }), Limits::min() - Limits::denorm_min());
}

TEST(ExactSum, RoundsOnceToNearestAndEven)
{
  const double half = 0.5 * Limits::epsilon();
  EXPECT_EQ(sumOf({ 1.0, half }), 1.0);
  EXPECT_EQ(sumOf({ 1.0 + Limits::epsilon(), half }), 1.0 + 2.0 * Limits::epsilon());
  EXPECT_EQ(sumOf({ 1.0, half, Limits::denorm_min() }), 1.0 + Limits::epsilon());
  EXPECT_EQ(sumOf({ 1.0, half, -Limits::denorm_min() }), 1.0);
  EXPECT_EQ(sumOf({ -1.0, -half, -Limits::denorm_min() }), -1.0 - Limits::epsilon());
  EXPECT_EQ(sumOf(std::vector<double>(10, 0.1)), 1.0);
}

TEST(ExactSum, OfOneTermIsTheTerm)
{
  for (const double term : mixedTerms())
  {
    EXPECT_EQ(sumOf({ term }), term);
  }
}

TEST(ExactSum, AnyOrderAndParts)
{
  std::vector<double> terms = mixedTerms();
  const double sum = sumOf(terms);
  std::mt19937_64 random(8);
  for (int turn = 0; turn < 5; ++turn)
  {
    std::shuffle(terms.begin(), terms.end(), random);
    EXPECT_EQ(sumOf(terms), sum);
  }
  ExactSum all;
  for (std::size_t first = 0; first < terms.size(); first += 700)
  {
    ExactSum part;
    for (std::size_t i = first; i < std::min(first + 700, terms.size()); ++i)
    {
      part.Add(terms[i]);
    }
    all.Add(part);
  }
  EXPECT_EQ(all.Value(), sum);
  for (double& term : terms)
  {
    term = -term;
  }
  EXPECT_EQ(sumOf(terms), -sum);
}

TEST(ExactSum, ManyTermsOfOneSign)
{
  constexpr int count = 1 << 20;
  ExactSum sum;
  ExactSum twice;
  for (int i = 0; i < count; ++i)
  {
    sum.Add(0.1);
  }
  twice.Add(sum);
  twice.Add(sum);
  EXPECT_EQ(sum.Value(), 0.1 * count);
  EXPECT_EQ(twice.Value(), 0.2 * count);
}

TEST(ExactSum, WhatIsNotFiniteStays)
{
  const double infinity = Limits::infinity();
  EXPECT_EQ(sumOf({ 1.0, infinity }), infinity);
  EXPECT_EQ(sumOf({ -infinity, 1.0 }), -infinity);
  EXPECT_TRUE(std::isnan(sumOf({ infinity, -infinity })));
  EXPECT_TRUE(std::isnan(sumOf({ 1.0, Limits::quiet_NaN() })));
}

TEST(ExactSum, RangesOfAnyExecutor)
{
  const std::vector<double> terms = mixedTerms();
  const auto sumIn = [&](const Executor& executor) {
    Progress progress{ Context(executor) };
    return sumExactly<ExactSum>(progress, static_cast<std::int64_t>(terms.size()), 64,
      [&](std::int64_t first, std::int64_t last, ExactSum& sum) {
        for (std::int64_t i = first; i < last; ++i)
        {
          sum.Add(terms[static_cast<std::size_t>(i)]);
        }
      })
      .Value();
  };
  EXPECT_EQ(sumIn(SerialExecutor()), sumOf(terms));
  EXPECT_EQ(sumIn(OpenMPExecutor()), sumOf(terms));
}

} // namespace
} // namespace RectifiedTransport
