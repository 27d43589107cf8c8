// SPDX-License-Identifier: BSD-3-Clause
// Values of a density that are probably not meant: a value that carries most of the mass, for
// example a number that marks missing data in files.
#ifndef RectifiedTransport_SuspectValues_h
#define RectifiedTransport_SuspectValues_h

#include "Core/Tables/Density.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// The largest finite value, the number of tuples that have it, and the next value below it.
struct LargestValue
{
  double Value = -std::numeric_limits<double>::infinity(); // none yet
  std::int64_t Count = 0;
  std::int64_t First = -1;
  double Next = -std::numeric_limits<double>::infinity();
};

// The lowest of the values that NegativeValues = Clamp takes as 0.
struct LowestValue
{
  double Value = 0.0; // 0 where none is negative
  std::int64_t Count = 0;
  std::int64_t First = -1;
  double Negative = 0.0; // the sum of all negative values
  double Largest = 0.0;
};

// What is known about the values of a density after reading them.
struct SuspectValues
{
  DensitySummary Found;
  LargestValue White;  // where white is found among the values, else without a value
  LowestValue Clamped; // where negative values are
};

// Adds what is known about the values that follow those of `all`.
void merge(const LargestValue& part, LargestValue& all);
void merge(const LowestValue& part, LowestValue& all);

// A number that marks missing data, as the field data of the input say.
struct FillValue
{
  std::string Name;
  double Value;
};

// How messages name the values of a density.
struct ValuePlaces
{
  // The arrays that have the largest density, white, and the lowest value.
  std::string Largest;
  std::string White;
  std::string Lowest;
  const char* Of; // "cells"
  std::int64_t All;
  bool IsInverted; // the densities are white minus the values
  bool IsColour;   // of several components
  std::vector<FillValue> FillValues;
};

// A line for each finding. `shareOfLargest` gives the part of the mass that the largest density
// carries; without it, all values are of cells of one size.
std::vector<std::string> describeSuspect(const SuspectValues& values, const ValuePlaces& places,
  const std::function<double()>& shareOfLargest = nullptr);

} // namespace RectifiedTransport

#endif
