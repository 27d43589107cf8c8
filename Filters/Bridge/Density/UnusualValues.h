// SPDX-License-Identifier: BSD-3-Clause
// Values of a density that are probably not meant: a value that carries most of the mass, for
// example a number that marks missing data in files.
#ifndef RectifiedTransport_UnusualValues_h
#define RectifiedTransport_UnusualValues_h

#include "Bridge/Density/DensityReader.h"
#include "Core/Tables/Density.h"

#include <cstdint>
#include <limits>
#include <string>

namespace RectifiedTransport
{

class Progress;
class Ranks;

constexpr double mostOfMass = 0.5;

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
struct UnusualValues
{
  DensitySummary Found;
  LargestValue White;  // where white is found among the values, else without a value
  LowestValue Clamped; // where negative values are
};

// Adds what is known about the values that follow those of `all`.
void merge(const LargestValue& part, LargestValue& all);
void merge(const LowestValue& part, LowestValue& all);

// Whether files use this number for missing data: -999, 9999, 1e20, 9.96921e36 and so on.
bool isFillValue(double value);

// Whether one value may carry most of the mass by mistake, judged only by the values: it is in a
// single cell, or in several cells and far above all others. `raw` is the array's value for the
// largest density.
bool isUnusualLargest(const DensitySummary& found, double raw, std::int64_t values);
bool isUnusualWhite(const LargestValue& white);
bool isUnusualLowest(const LowestValue& lowest);

// The values that `rules` clamp, in `count` tuples that `reader` reads by these rules. Runs as the
// current stage. Throws Cancelled.
LowestValue findLowest(
  vtkDataArray* array, const DensityReader& reader, std::int64_t count, Progress& progress);

// How a message names the cells or points that have a value.
struct ValuePlaces
{
  std::string Name; // of the array
  const char* Of;   // "cells"
  std::int64_t All;
};

// One line for each finding.
std::string describeLargest(
  const ValuePlaces& places, const DensitySummary& found, double raw, double share);
std::string describeWhite(const ValuePlaces& places, const LargestValue& white);
std::string describeLowest(const ValuePlaces& places, const LowestValue& lowest);

} // namespace RectifiedTransport

#endif
