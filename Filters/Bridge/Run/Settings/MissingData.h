// SPDX-License-Identifier: BSD-3-Clause
// The properties of missing data: which values mark empty cells, and what empty cells count as.
#ifndef RectifiedTransport_MissingData_h
#define RectifiedTransport_MissingData_h

#include "Bridge/Run/PropertyCheck.h"

#include <cmath>
#include <limits>

namespace RectifiedTransport::Bridge
{

// Indexed by the enumerations of vtkDensityAlgorithm.
constexpr const char* NaNValuesTexts[] = { "Error", "Empty" };
constexpr const char* EmptyCellsTexts[] = { "Zero", "Mean", "Minimum", "Value" };

// Which values of an array mark empty cells.
struct MissingValues
{
  bool AreNaN = false; // otherwise NaN is an error
  // Values outside are missing. An infinite end is no bound; infinite values are then errors.
  double Low = -std::numeric_limits<double>::infinity();
  double High = std::numeric_limits<double>::infinity();

  bool Are() const
  {
    constexpr double all = std::numeric_limits<double>::infinity();
    return this->AreNaN || this->Low > -all || this->High < all;
  }
  bool Has(double value) const
  {
    return value < this->Low || value > this->High || (this->AreNaN && std::isnan(value));
  }
};

// An end of ValidRange of this size or more is no bound.
constexpr double Unbounded = 1e299;

// Throws Failure for values out of range.
inline MissingValues missingValues(int nanValues, const double (&validRange)[2])
{
  requireChoice("NaNValues", nanValues, NaNValuesTexts);
  if (!(validRange[0] <= validRange[1])) // or NaN
  {
    throw Failure("ValidRange is " + textOf(validRange[0]) + " to " + textOf(validRange[1]) +
      "; it must be two numbers of which the first is at most the second");
  }
  MissingValues missing;
  missing.AreNaN = nanValues == 1;
  missing.Low = validRange[0] > -Unbounded ? validRange[0] : missing.Low;
  missing.High = validRange[1] < Unbounded ? validRange[1] : missing.High;
  return missing;
}

// The density of empty cells: none, the mean or the least of the other cells, or a value.
enum class EmptyCells
{
  Zero,
  Mean,
  Minimum,
  Value
};

struct EmptyRule
{
  EmptyCells Cells = EmptyCells::Zero;
  double Value = 0.0; // of EmptyCells::Value, else 0
};

// Throws Failure for values out of range.
inline EmptyRule emptyRule(int cells, double value)
{
  requireChoice("EmptyCells", cells, EmptyCellsTexts);
  requireThat(value >= 0.0 && std::isfinite(value), "EmptyValue", value, "finite and at least 0");
  const auto rule = static_cast<EmptyCells>(cells);
  return { rule, rule == EmptyCells::Value ? value : 0.0 };
}

} // namespace RectifiedTransport::Bridge

#endif
