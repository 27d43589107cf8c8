// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/Reading/EmptyParts.h"

#include "Core/Parallel/Progress.h"
#include "Core/Tables/Reading/FilledCells.h"

#include <algorithm>

namespace RectifiedTransport
{

double fillEmptyParts(const double* covered, std::int64_t cells,
  const std::vector<SetFindings>& findings, const EmptyRule& rule, Progress& progress,
  double* values)
{
  constexpr double rounding = 1e-9;
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const auto shareOf = [covered](std::int64_t cell) {
    const double share = covered[cell]; // more than 1 where cells overlap
    return share > 1.0 - rounding ? 1.0 : share;
  };
  FilledCells filled;
  for (const SetFindings& set : findings)
  {
    filled.Least = std::min(filled.Least, set.Least);
  }
  filled.Add(sumExactly<FilledCells>(
    progress, cells, grain, [&](std::int64_t first, std::int64_t last, FilledCells& part) {
      for (std::int64_t cell = first; cell < last; ++cell)
      {
        part.Mass.Add(values[cell]);
        part.Cells.Add(shareOf(cell));
      }
    }));
  const double empty = densityOfEmptyCells(rule, filled);
  progress.For(cells, grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t cell = first; cell < last; ++cell)
    {
      values[cell] += (1.0 - shareOf(cell)) * empty;
    }
  });
  return empty;
}

} // namespace RectifiedTransport
