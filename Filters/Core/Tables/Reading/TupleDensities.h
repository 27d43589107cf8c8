// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic from the tuples of an array to densities; begin(i, c) is component c of tuple i.
#ifndef RectifiedTransport_TupleDensities_h
#define RectifiedTransport_TupleDensities_h

#include "Core/Tables/Reading/DensityRules.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace RectifiedTransport
{

// Luminance by Rec. 709. For integer types it is a whole number of ten-thousandths, so that a grey
// has exactly its own value: the double 1e-4 is near enough to 1/10000 (5e-17 relatively) for the
// product to round to the integer.
template <class T>
double luminance(T red, T green, T blue)
{
  constexpr double unit = 1e-4;
  if constexpr (std::is_floating_point_v<T>)
  {
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  }
  else if constexpr (sizeof(T) <= 2)
  {
    const std::int32_t sum =
      2126 * std::int32_t{ red } + 7152 * std::int32_t{ green } + 722 * std::int32_t{ blue };
    return unit * sum;
  }
  else
  {
    return unit *
      (2126.0 * static_cast<double>(red) + 7152.0 * static_cast<double>(green) +
        722.0 * static_cast<double>(blue));
  }
}

// Rounding of a luminance may exceed white; a comparison keeps NaN.
inline double positivePart(double value)
{
  return value < 0.0 ? 0.0 : value;
}

// The Euclidean norm of tuple i.
template <class Tuples>
double magnitude(const Tuples& begin, int components, std::int64_t i)
{
  double sum = 0.0;
  for (int c = 0; c < components; ++c)
  {
    const double value = static_cast<double>(begin(i, c));
    sum += value * value;
  }
  // The squares neither overflowed nor lost digits near 0. NaN and zeros take the other way.
  constexpr double least = 1e-280;
  if (sum >= least && sum <= std::numeric_limits<double>::max())
  {
    return std::sqrt(sum);
  }
  double largest = 0.0;
  for (int c = 0; c < components; ++c)
  {
    largest = std::max(largest, std::abs(static_cast<double>(begin(i, c))));
  }
  if (std::isnan(sum) || std::isinf(largest) || largest == 0.0)
  {
    return sum;
  }
  // Scaled by the largest component, the squares are at most 1.
  double scaled = 0.0;
  for (int c = 0; c < components; ++c)
  {
    const double value = static_cast<double>(begin(i, c)) / largest;
    scaled += value * value;
  }
  return largest * std::sqrt(scaled);
}

// The loops over tuples; begin(i, c) is component c of tuple i.
template <class Tuples>
void readTuples(const Tuples& begin, int components, std::int64_t count, const DensityRules& rules,
  double white, double* __restrict values)
{
  // Each kind has a loop of its own, so that the compiler can vectorize it.
  const auto setAll = [count](double* __restrict to, const auto& valueOf) {
    for (std::int64_t i = 0; i < count; ++i)
    {
      to[i] = valueOf(i, to[i]);
    }
  };
  const bool isColour = rules.Component == Luminance;
  if (rules.Component == Magnitude)
  {
    setAll(values, [&](std::int64_t i, double) { return magnitude(begin, components, i); });
  }
  else if (isColour && components >= 3)
  {
    setAll(values,
      [&](std::int64_t i, double) { return luminance(begin(i, 0), begin(i, 1), begin(i, 2)); });
  }
  else
  {
    const int c = isColour ? 0 : rules.Component;
    setAll(values, [&](std::int64_t i, double) { return static_cast<double>(begin(i, c)); });
  }
  const int alpha = components - 1;
  if (isColour && components != 3)
  {
    // Alpha composites the colour over white: white - (white - value) * opacity. The inverted
    // density is the ink, (white - value) * opacity.
    setAll(values, [&](std::int64_t i, double known) {
      const double opacity = white > 0.0 ? static_cast<double>(begin(i, alpha)) / white : 1.0;
      const double ink = (white - known) * opacity;
      return rules.Invert ? positivePart(ink) : white - ink;
    });
  }
  else if (rules.Invert)
  {
    setAll(values, [&](std::int64_t, double known) {
      const double value = white - known;
      return isColour ? positivePart(value) : value;
    });
  }
}

// Whether a tuple has no valid value of the component, of a colour's components or of any of the
// magnitude's. Alpha is no value, but NaN would make the density NaN.
template <class Tuples>
bool isMissing(
  const Tuples& begin, int components, std::int64_t i, int component, const MissingValues& missing)
{
  if (component >= 0)
  {
    return missing.Has(static_cast<double>(begin(i, component)));
  }
  const int valued = component == Magnitude ? components : components >= 3 ? 3 : 1;
  bool is = false;
  for (int c = 0; c < valued; ++c)
  {
    is = is || missing.Has(static_cast<double>(begin(i, c)));
  }
  const bool hasAlpha = components == valued + 1;
  return is || (hasAlpha && missing.AreNaN && std::isnan(static_cast<double>(begin(i, valued))));
}

} // namespace RectifiedTransport

#endif
