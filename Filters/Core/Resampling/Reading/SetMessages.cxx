// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/Reading/SetMessages.h"

#include "Core/Resampling/CellSums.h"

#include <cstddef>
#include <cstdint>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

std::string percent(double part, double whole)
{
  std::ostringstream text;
  text.precision(2);
  text << (whole > 0.0 ? 100.0 * part / whole : 0.0) << " %";
  return text.str();
}

// "(the first is cell 3)", or "cell 3 of block 1 of the input".
std::string firstText(const std::vector<CellValues>& sets, std::size_t set, std::int64_t cell)
{
  return " (the first is cell " + std::to_string(cell) +
    (sets.size() > 1 ? " of " + sets[set].Cells().Name : "") + ")";
}

// Adds what is known about a set's values. `isBeyond` says whether its value replaces that of the
// sets before. Sets number their values each from 0: the index stays that of the set of this name.
template <class Found>
void addSet(const std::string& array, const Found& part, std::int64_t Found::*index, bool isBeyond,
  Found& all, std::string& name)
{
  const std::int64_t first = all.*index;
  merge(part, all);
  if (name.empty() || isBeyond)
  {
    name = array;
    return;
  }
  all.*index = first;
}

} // namespace

std::vector<std::string> describeLost(
  const std::vector<CellValues>& sets, const CellSize& size, int dimension)
{
  std::vector<std::string> warnings;
  if (size.LeftOut > 0)
  {
    warnings.push_back(std::to_string(size.LeftOut) + (size.LeftOut == 1 ? " cell" : " cells") +
      " of the input" + firstText(sets, size.Set, size.FirstLeftOut) +
      " could not be divided into simplices and carry no mass: at most " +
      percent(size.LeftOutIntegral, size.LeftOutIntegral + size.Integral) + " of the mass, and " +
      percent(size.LeftOutMeasure, size.LeftOutMeasure + size.Measure) + " of the " +
      (dimension == 3      ? "volume"
          : dimension == 2 ? "area"
                           : "length") +
      ", are in the boxes around them");
  }
  std::int64_t open = 0;
  std::string first;
  for (std::size_t b = 0; b < sets.size(); ++b)
  {
    // The first set with open lines names one.
    first = open == 0 ? firstText(sets, b, sets[b].FirstOpenLine()) : first;
    open += sets[b].OpenLines();
  }
  if (open > 0)
  {
    warnings.push_back(std::to_string(open) +
      (open == 1 ? " line of the input is not closed" + first + " and carries no mass"
                 : " lines of the input are not closed" + first + " and carry no mass") +
      "; lines around regions must end where they begin");
  }
  return warnings;
}

// Findings of all sets as one: the largest density, the white and the lowest value each with the
// array that has it. The share of the mass at the largest value needs an integral, which is
// computed only if it is reported.
std::vector<std::string> describeSuspect(const std::vector<CellValues>& sets,
  const std::vector<SetFindings>& findings, ValuePlaces places, const ImageGrid& grid,
  Progress& progress)
{
  // The values of all sets together.
  SuspectValues all;
  for (const SetFindings& set : findings)
  {
    const SuspectValues& known = set.Known;
    addSet(set.Array, known.Found, &DensitySummary::FirstMaximum,
      known.Found.Maximum > all.Found.Maximum, all.Found, places.Largest);
    addSet(set.Array, known.White, &LargestValue::First, known.White.Value > all.White.Value,
      all.White, places.White);
    addSet(set.Array, known.Clamped, &LowestValue::First, known.Clamped.Value < all.Clamped.Value,
      all.Clamped, places.Lowest);
  }
  for (const CellValues& cells : sets)
  {
    places.All += cells.NumberOfValues();
  }
  return describeSuspect(all, places, [&]() {
    std::vector<CellValues> only;
    for (const CellValues& cells : sets)
    {
      // The density where it has its largest value, 0 elsewhere.
      only.push_back(cells.Only(all.Found.Maximum));
    }
    return integralOf(only, grid, progress) / integralOf(sets, grid, progress);
  });
}

} // namespace RectifiedTransport
