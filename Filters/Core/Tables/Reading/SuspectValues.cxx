// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/Reading/SuspectValues.h"

#include "Core/Messages/PropertyCheck.h"
#include "Core/Tables/Reading/DensityRules.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

// With fewer values, one that dominates is normal.
constexpr std::int64_t fewest = 8;
// The largest ratio of the next value to this one, for a value that belongs to other data (1e-6),
// for one beside which adding up hides all others (1e-15), and for a number that is known to mark
// missing data (0.9).
constexpr double farBelow = 1e-6;
constexpr double nothingBelow = 1e-15;
constexpr double below = 0.9;
// A finding needs a value that carries more than half the mass.
constexpr double mostOfMass = 0.5;

// Whether files use this number for missing data: -999, 9999, 1e20, 9.96921e36 and so on.
bool isFillValue(double value)
{
  constexpr double always = 1e30; // 1e30, 9.96921e36, 1.70141e38, the largest float
  constexpr double tens = 1e10;
  const double size = std::abs(value);
  if (size >= always || value == -32768.0 || value == -2147483648.0 || value == 2147483647.0)
  {
    return true;
  }
  const double power = std::round(std::log10(std::max(size, 1.0)));
  const double ten = std::pow(10.0, power);
  // Powers of ten, also as rounded to floats; and 999, 9999, 99999 and so on.
  return size >= tens ? std::abs(size / ten - 1.0) < 1e-7 : power >= 3.0 && size == ten - 1.0;
}

// Returns the part of the mass that the largest density carries if all cells have the same size.
double shareByValues(const DensitySummary& found)
{
  const double total = std::max(found.Total, found.Maximum);
  return static_cast<double>(found.Maxima) * (found.Maximum / total);
}

// Whether the largest density may carry most of the mass by mistake: it is in a single cell, or in
// several cells and far above all others.
bool isSuspectLargest(const DensitySummary& found, double raw, std::int64_t values)
{
  const double largest = found.Maximum;
  const double next = found.BelowMaximum;
  // No finding in a constant density, or if the largest value carries little.
  if (values < fewest || !(largest > found.Minimum) || !(shareByValues(found) > mostOfMass))
  {
    return false;
  }
  if (isFillValue(raw) && next <= below * largest)
  {
    return true;
  }
  // A single cell with most of the mass is unusual if any other value is positive.
  if (found.Maxima == 1)
  {
    return next > 0.0;
  }
  // Two values may be a mask and its ground.
  return next > 0.0 && next <= (found.Minimum < next ? farBelow : nothingBelow) * largest;
}

// White far above all other values makes all densities white - value nearly equal.
bool isSuspectWhite(const LargestValue& white)
{
  // The others then differ by at most this part of white.
  constexpr double farFromAll = 1e-10;
  return std::isfinite(white.Value) && std::isfinite(white.Next) && white.Value > 0.0 &&
    white.Next != 0.0 &&
    (std::abs(white.Next) <= farFromAll * white.Value ||
      (isFillValue(white.Value) && white.Next <= below * white.Value));
}

// Negative values whose sum is mostly one value, which is a fill value or far below all others.
bool isSuspectLowest(const LowestValue& lowest)
{
  return lowest.Count > 0 &&
    static_cast<double>(lowest.Count) * (lowest.Value / lowest.Negative) > mostOfMass &&
    (isFillValue(lowest.Value) ||
      (lowest.Largest > 0.0 && lowest.Largest <= farBelow * -lowest.Value));
}

std::string countOf(std::int64_t count, std::int64_t first, const ValuePlaces& places)
{
  std::ostringstream text;
  text << count << " of " << places.All << " " << places.Of
       << (count == 1 ? " (index " : " (the first at index ") << first << ")";
  return text.str();
}

// Returns the array's value that gives a density; for a colour, its luminance.
double rawValue(const SuspectValues& values, const ValuePlaces& places, double density)
{
  return places.IsInverted && !places.IsColour ? values.White.Value - density : density;
}

// Returns the name of the field data's fill value, or an empty text. Files round such values to
// floats.
std::string nameOfFillValue(const ValuePlaces& places, double value)
{
  for (const FillValue& fill : places.FillValues)
  {
    if (fill.Value == value || static_cast<double>(static_cast<float>(fill.Value)) == value)
    {
      return fill.Name;
    }
  }
  return {};
}

// "; if it marks missing data, ValidRange = 0 5 leaves it out".
std::string advice(const std::string& fillName, const std::string& range)
{
  return (fillName.empty() ? "; if it marks missing data, "
                           : "; it is the " + fillName + " of the field data: ") +
    "ValidRange" + (range.empty() ? "" : " = " + range) + " leaves it out";
}

// The range of ValidRange without a lower bound.
std::string upTo(double value)
{
  return textOf(-Unbounded) + " " + textOf(value);
}

// Returns the range of all values except the one with the largest density.
std::string rangeWithout(const SuspectValues& values, const ValuePlaces& places)
{
  const double next = rawValue(values, places, values.Found.BelowMaximum);
  return places.IsColour ? ""
    : places.IsInverted  ? textOf(next) + " " + textOf(Unbounded)
                         : upTo(next);
}

std::string describeLargest(const ValuePlaces& places, const SuspectValues& values, double share)
{
  const DensitySummary& found = values.Found;
  const double raw = rawValue(values, places, found.Maximum);
  const std::string fillName = nameOfFillValue(places, raw);
  std::ostringstream text;
  text << "The value " << raw << " of the " << places.Largest << ", in "
       << countOf(found.Maxima, found.FirstMaximum, places) << ", carries ";
  text.precision(3);
  text << 100.0 * share << " % of the mass";
  text.precision(6);
  if (!isFillValue(raw) && fillName.empty())
  {
    text << ", the next largest is " << found.BelowMaximum << " as a density";
  }
  return text.str() + advice(fillName, rangeWithout(values, places));
}

std::string describeWhite(const ValuePlaces& places, const LargestValue& white)
{
  std::ostringstream text;
  text << "InvertDensity takes the value " << white.Value << " of the " << places.White << ", in "
       << countOf(white.Count, white.First, places) << ", for white, and the next largest is "
       << white.Next << ": all others carry about equal mass";
  return text.str() +
    advice(nameOfFillValue(places, white.Value), places.IsColour ? "" : upTo(white.Next));
}

std::string describeLowest(const ValuePlaces& places, const LowestValue& lowest)
{
  std::ostringstream text;
  text << "The value " << lowest.Value << " of the " << places.Lowest << ", in "
       << countOf(lowest.Count, lowest.First, places) << ", is ";
  text.precision(3);
  text << 100.0 * static_cast<double>(lowest.Count) * (lowest.Value / lowest.Negative)
       << " % of what NegativeValues = Clamp takes as 0";
  return text.str() + advice(nameOfFillValue(places, lowest.Value), "0 " + textOf(Unbounded));
}

} // namespace

void merge(const LargestValue& part, LargestValue& all)
{
  // The second largest of both parts is the loser's maximum or one of the seconds.
  const double next = std::max(std::min(part.Value, all.Value), std::max(part.Next, all.Next));
  if (part.Value == all.Value)
  {
    all.Next = std::max(part.Next, all.Next);
    all.First =
      all.Count > 0 && (part.Count == 0 || all.First < part.First) ? all.First : part.First;
    all.Count += part.Count;
    return;
  }
  all = part.Value > all.Value ? part : all;
  all.Next = next;
}

void merge(const LowestValue& part, LowestValue& all)
{
  const double negative = all.Negative + part.Negative;
  const double largest = std::max(all.Largest, part.Largest);
  if (part.Value < all.Value)
  {
    all = part;
  }
  else if (part.Value == all.Value && part.Count > 0)
  {
    all.First = all.Count > 0 ? std::min(all.First, part.First) : part.First;
    all.Count += part.Count;
  }
  all.Negative = negative;
  all.Largest = largest;
}

// The largest density gives one line, or else white does; the values that Clamp takes as 0 may give
// another one.
std::vector<std::string> describeSuspect(const SuspectValues& values, const ValuePlaces& places,
  const std::function<double()>& shareOfLargest)
{
  std::vector<std::string> lines;
  const double raw = rawValue(values, places, values.Found.Maximum);
  if (isSuspectLargest(values.Found, raw, places.All))
  {
    const double share = shareOfLargest ? shareOfLargest() : shareByValues(values.Found);
    if (share > mostOfMass)
    {
      lines.push_back(describeLargest(places, values, share));
    }
  }
  else if (places.IsInverted && isSuspectWhite(values.White))
  {
    lines.push_back(describeWhite(places, values.White));
  }
  if (isSuspectLowest(values.Clamped))
  {
    lines.push_back(describeLowest(places, values.Clamped));
  }
  return lines;
}

} // namespace RectifiedTransport
