// SPDX-License-Identifier: BSD-3-Clause
// Reads an array of any value type and memory layout as a density, without a copy.
#ifndef RectifiedTransport_DensityReader_h
#define RectifiedTransport_DensityReader_h

#include "Core/Tables/Density.h"
#include "Core/Tables/Reading/DensityRules.h"
#include "Core/Tables/Reading/SuspectValues.h"
#include "Core/Tables/Reading/TupleDensities.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>

namespace RectifiedTransport
{

class Progress;

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
