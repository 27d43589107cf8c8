// SPDX-License-Identifier: BSD-3-Clause
// How the values of an array become a density: which component, which values are missing, and what
// cells without a value count as.
#ifndef RectifiedTransport_DensityRules_h
#define RectifiedTransport_DensityRules_h

#include <cmath>
#include <limits>

namespace RectifiedTransport
{

// What the property Component may be besides an index. Auto is one of the others, by the array.
enum ComponentChoice : int
{
  AutoComponent = -1,
  Luminance = -2,
  Magnitude = -3
};

constexpr int MostColorComponents = 4;

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
  double Value = 0.0; // the value for EmptyCells::Value, else 0
};

// How the values of an array become a density.
struct DensityRules
{
  int Component = AutoComponent; // an index or a ComponentChoice
  bool Invert = false;           // white - value
  bool ClampNegative = false;
  MissingValues Missing;
  EmptyRule Empty; // what cells without a value, blanked ones among them, count as

  // The members below require a component that is taken, not Auto.
  bool IsOfSeveral() const { return this->Component < 0; }
  // Whether the density of an array with this many components needs the largest displayed value.
  bool NeedsWhite(int components) const
  {
    const bool alpha = this->Component == Luminance && (components == 2 || components == 4);
    return this->Invert || alpha;
  }
};

} // namespace RectifiedTransport

#endif
