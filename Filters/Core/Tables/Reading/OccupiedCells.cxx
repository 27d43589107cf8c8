// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/Reading/OccupiedCells.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

void OccupiedCells::Add(const double* values, const unsigned char* empty, std::int64_t count)
{
  std::int64_t filled = 0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    if ((!empty || empty[i] == 0) && values[i] >= 0.0 && std::isfinite(values[i]))
    {
      this->Mass.Add(values[i]);
      this->Least = std::min(this->Least, values[i]);
      ++filled;
    }
  }
  this->Cells.Add(static_cast<double>(filled));
}

void OccupiedCells::Add(const OccupiedCells& other)
{
  this->Mass.Add(other.Mass);
  this->Cells.Add(other.Cells);
  this->Least = std::min(this->Least, other.Least);
}

// Empty cells without any filled ones have no mean or minimum; the tables then report a mass of 0.
double densityOfEmptyCells(const EmptyRule& rule, const OccupiedCells& filled)
{
  const double cells = filled.Cells.Value();
  if (rule.Cells == EmptyCells::Zero || !(cells > 0.0))
  {
    return 0.0;
  }
  if (rule.Cells == EmptyCells::Value)
  {
    return rule.Value;
  }
  if (rule.Cells == EmptyCells::Minimum)
  {
    return std::isfinite(filled.Least) ? filled.Least : 0.0;
  }
  // The mean density of the filled cells.
  const double mean = filled.Mass.Value() / cells;
  return std::isfinite(mean) ? mean : 0.0; // too much mass is an error of the tables
}

double fillEmptyParts(const double* covered, std::int64_t cells, OccupiedCells filled,
  const EmptyRule& rule, Progress& progress, double* values)
{
  // Overlaps that add up to 1 up to rounding count as a whole cell.
  constexpr double rounding = 1e-9;
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const auto shareOf = [covered](std::int64_t cell) {
    const double share = covered[cell]; // more than 1 where cells overlap
    return share > 1.0 - rounding ? 1.0 : share;
  };
  // The mean over covered cells is (sum of the values) / (sum of the covered shares): values are
  // already weighted by their shares.
  filled.Add(sumExactly<OccupiedCells>(
    progress, cells, grain, [&](std::int64_t first, std::int64_t last, OccupiedCells& part) {
      for (std::int64_t cell = first; cell < last; ++cell)
      {
        part.Mass.Add(values[cell]);
        part.Cells.Add(shareOf(cell));
      }
    }));
  // All parts without data have the same density, weighted by their share of the cell.
  const double empty = densityOfEmptyCells(rule, filled);
  progress.ForEach(
    cells, grain, [&](std::int64_t cell) { values[cell] += (1.0 - shareOf(cell)) * empty; });
  return empty;
}

} // namespace RectifiedTransport
