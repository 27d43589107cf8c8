// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityReader.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// Rec. 709. Whole ten-thousandths, so that a grey of an integer type has exactly its own value: the
// double 1e-4 is near enough to it (5e-17, relatively) for the product to round to the integer.
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
double positivePart(double value)
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
  // Squares that neither overflow nor lose digits near 0. NaN and zeros go the other way.
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
  if (rules.Component != Luminance)
  {
    const int c = rules.Component;
    if (c == Magnitude)
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        values[i] = magnitude(begin, components, i);
      }
    }
    else
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        values[i] = static_cast<double>(begin(i, c));
      }
    }
    if (rules.Invert)
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        values[i] = white - values[i];
      }
    }
    return;
  }
  if (components >= 3)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] = luminance(begin(i, 0), begin(i, 1), begin(i, 2));
    }
  }
  else
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] = static_cast<double>(begin(i, 0));
    }
  }
  if (components == 3)
  {
    if (rules.Invert)
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        values[i] = positivePart(white - values[i]);
      }
    }
    return;
  }
  const int alpha = components - 1;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double opacity = white > 0.0 ? static_cast<double>(begin(i, alpha)) / white : 1.0;
    const double ink = (white - values[i]) * opacity;
    values[i] = rules.Invert ? positivePart(ink) : white - ink;
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

// A reader of arrays whose tuples `Tuples` visits in runs, see BlockOfTuples.
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

private:
  Tuples Run;
};

// Contiguous tuples. Their number of components is a compile-time constant up to 4, so that the
// loops are vectorised.
template <class T>
class BlockOfTuples
{
public:
  explicit BlockOfTuples(vtkAOSDataArrayTemplate<T>* array)
    : Values(array->GetPointer(0))
    , Components(array->GetNumberOfComponents())
  {
  }

  template <class Visit>
  void VisitTuples(std::int64_t first, std::int64_t, const Visit& visit) const
  {
    const T* block = this->Values + first * this->Components;
    const auto visitAs = [&](auto components) {
      constexpr int N = decltype(components)::value;
      visit([block](std::int64_t i, int c) { return block[i * N + c]; }, N);
    };
    switch (this->Components)
    {
      case 1:
        return visitAs(std::integral_constant<int, 1>());
      case 2:
        return visitAs(std::integral_constant<int, 2>());
      case 3:
        return visitAs(std::integral_constant<int, 3>());
      case 4:
        return visitAs(std::integral_constant<int, 4>());
      default:
        return visit(
          [block, n = this->Components](std::int64_t i, int c) { return block[i * n + c]; },
          this->Components);
    }
  }

private:
  const T* Values;
  int Components;
};

// Tuples of any other memory layout.
template <class ArrayT>
class RangeOfTuples
{
public:
  explicit RangeOfTuples(ArrayT* array)
    : Array(array)
    , Components(array->GetNumberOfComponents())
  {
  }

  template <class Visit>
  void VisitTuples(std::int64_t first, std::int64_t count, const Visit& visit) const
  {
    const auto range = vtk::DataArrayValueRange(
      this->Array, first * this->Components, (first + count) * this->Components);
    visit(
      [&range, n = this->Components](std::int64_t i, int c) {
        using Value = typename std::decay_t<decltype(range)>::ValueType;
        return static_cast<Value>(range[i * n + c]);
      },
      this->Components);
  }

private:
  ArrayT* Array;
  int Components;
};

struct MakeReader
{
  const DensityRules& Rules;
  std::unique_ptr<DensityReader> Reader;

  template <class T>
  void operator()(vtkAOSDataArrayTemplate<T>* array)
  {
    this->Reader = std::make_unique<TupleReader<BlockOfTuples<T>>>(array, this->Rules);
  }

  template <class ArrayT>
  void operator()(ArrayT* array)
  {
    this->Reader = std::make_unique<TupleReader<RangeOfTuples<ArrayT>>>(array, this->Rules);
  }
};

} // namespace

void DensityReader::Finish(std::int64_t first, std::int64_t count, double* values) const
{
  if (this->Rules.ClampNegative)
  {
    // Minus infinity remains, and is an error.
    constexpr double lowest = std::numeric_limits<double>::lowest();
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] = values[i] < 0.0 && values[i] >= lowest ? 0.0 : values[i];
    }
  }
  if (this->Flags)
  {
    const unsigned char* flags = this->Flags + first;
    const unsigned char mask = this->Mask;
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] = (flags[i] & mask) ? this->Empty : values[i];
    }
  }
}

std::unique_ptr<DensityReader> DensityReader::MakeUnclamped(vtkDataArray* array) const
{
  DensityRules rules = this->Rules;
  rules.ClampNegative = false;
  std::unique_ptr<DensityReader> made = makeDensityReader(array, rules);
  made->SetWhite(this->White);
  made->SetBlanks(this->Flags, this->Mask);
  return made;
}

std::unique_ptr<DensityReader> makeDensityReader(vtkDataArray* array, const DensityRules& rules)
{
  MakeReader make{ rules, nullptr };
  if (!vtkArrayDispatch::Dispatch::Execute(array, make))
  {
    make(array);
  }
  return std::move(make.Reader);
}

} // namespace RectifiedTransport::Bridge
