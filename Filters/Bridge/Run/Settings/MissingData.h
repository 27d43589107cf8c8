// SPDX-License-Identifier: BSD-3-Clause
// The properties of missing data: which values mark empty cells, and what empty cells count as.
#ifndef RectifiedTransport_MissingData_h
#define RectifiedTransport_MissingData_h

#include "Core/Messages/PropertyCheck.h"
#include "Core/Tables/Reading/DensityRules.h"

#include <cmath>

namespace RectifiedTransport::Bridge
{

// Indexed by the enumerations of vtkDensityAlgorithm.
constexpr const char* NaNValuesTexts[] = { "Error", "Empty" };
constexpr const char* EmptyCellsTexts[] = { "Zero", "Mean", "Minimum", "Value" };

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
