// SPDX-License-Identifier: BSD-3-Clause
// Reads an array of any value type and memory layout as a density, without a copy.
#ifndef RectifiedTransport_DensityReader_h
#define RectifiedTransport_DensityReader_h

#include "Core/Tables/Density.h"
#include "Core/Tables/Reading/DensityRules.h"
#include "Core/Tables/Reading/SuspectValues.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>

namespace RectifiedTransport
{

class Progress;

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

class DensityReader : public DensityValues
{
public:
  explicit DensityReader(const DensityRules& rules)
    : Rules(rules)
  {
  }

  // The largest displayed value, for Invert and alpha.
  void SetWhite(double white) { this->White = white; }
  // Cells whose flags have one of the bits of `mask` are empty.
  void SetBlanks(const unsigned char* flags, unsigned char mask)
  {
    this->Flags = flags;
    this->Mask = mask;
  }

  // The density of empty cells, 0 at first.
  void SetEmpty(double density) { this->Empty = density; }

  const DensityRules& GetRules() const { return this->Rules; }

  // Sets empty[i] where cell first + i is empty: blank or without a valid value. All components
  // that make the density must be valid; alpha must not be NaN.
  virtual void FindEmpty(std::int64_t first, std::int64_t count, unsigned char* empty) const = 0;

  // The largest value of the component, of all components (luminance) or of the magnitude, in cells
  // that are not empty.
  virtual LargestValue Largest(std::int64_t first, std::int64_t count) const = 0;

  // Reads the same, but leaves negative values as they are and takes empty cells as 0.
  virtual std::unique_ptr<DensityReader> MakeUnclamped() const = 0;

protected:
  bool IsBlank(std::int64_t cell) const { return this->Flags && (this->Flags[cell] & this->Mask); }
  // Applies ClampNegative and the blanking to values that were read.
  void Finish(std::int64_t first, std::int64_t count, double* values) const;

  DensityRules Rules;
  double White = 0.0;
  double Empty = 0.0;
  const unsigned char* Flags = nullptr;
  unsigned char Mask = 0;
};

// Reads arrays as runs of tuples; `Tuples` visits them and is constructed from an array.
template <class Tuples>
class TupleReader final : public DensityReader
{
public:
  template <class ArrayT>
  TupleReader(ArrayT* array, const DensityRules& rules)
    : DensityReader(rules)
    , Run(array)
  {
  }

  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    this->Run.VisitTuples(first, count, [&](const auto& begin, int components) {
      readTuples(begin, components, count, this->Rules, this->White, values);
      for (std::int64_t i = 0; this->Rules.Missing.Are() && i < count; ++i)
      {
        const bool is = isMissing(begin, components, i, this->Rules.Component, this->Rules.Missing);
        values[i] = is ? this->Empty : values[i];
      }
    });
    this->Finish(first, count, values);
  }

  void FindEmpty(std::int64_t first, std::int64_t count, unsigned char* empty) const override
  {
    const MissingValues& missing = this->Rules.Missing;
    for (std::int64_t i = 0; i < count; ++i)
    {
      empty[i] = this->IsBlank(first + i) ? 1 : 0;
    }
    if (missing.Are())
    {
      this->Run.VisitTuples(first, count, [&](const auto& begin, int components) {
        for (std::int64_t i = 0; i < count; ++i)
        {
          const bool is = isMissing(begin, components, i, this->Rules.Component, missing);
          empty[i] = is ? 1 : empty[i];
        }
      });
    }
  }

  LargestValue Largest(std::int64_t first, std::int64_t count) const override
  {
    LargestValue found;
    this->Run.VisitTuples(first, count, [&](const auto& begin, int components) {
      const int component = this->Rules.Component;
      const int low = std::max(component, 0);
      const int end = component == Luminance ? components : low + 1;
      LargestValue largest;
      for (std::int64_t i = 0; i < count; ++i)
      {
        if (this->IsBlank(first + i) ||
          (this->Rules.Missing.Are() &&
            isMissing(begin, components, i, component, this->Rules.Missing)))
        {
          continue;
        }
        for (int c = low; c < end; ++c)
        {
          const double value = component == Magnitude ? magnitude(begin, components, i)
                                                      : static_cast<double>(begin(i, c));
          if (value > largest.Value && value <= std::numeric_limits<double>::max())
          {
            largest = { value, 1, first + i, largest.Value };
          }
          else if (value == largest.Value)
          {
            ++largest.Count;
          }
          else if (value > largest.Next && value < largest.Value)
          {
            largest.Next = value;
          }
        }
      }
      found = largest;
    });
    return found;
  }

  std::unique_ptr<DensityReader> MakeUnclamped() const override
  {
    auto made = std::make_unique<TupleReader>(*this);
    made->Rules.ClampNegative = false;
    made->Empty = 0.0;
    return made;
  }

private:
  Tuples Run;
};

// The value that is read as white: 255 of bytes whose values are displayed, else the largest of
// `count` values. Throws Cancelled.
LargestValue findWhite(
  const DensityReader& reader, bool areBytes, std::int64_t count, Progress& progress);

// The values that the rules clamp, among `count` values. Throws Cancelled.
LowestValue findLowest(const DensityReader& reader, std::int64_t count, Progress& progress);

} // namespace RectifiedTransport

#endif
