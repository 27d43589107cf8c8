// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/DensityInspection.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

// Counts values that are not finite or negative; the first value is that of cell `index`.
void findWrong(const double* values, std::int64_t count, std::int64_t index, DensitySummary& found)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    if (!std::isfinite(values[i]))
    {
      found.FirstNotFinite = found.NotFinite++ == 0 ? index + i : found.FirstNotFinite;
    }
    else if (values[i] < 0.0)
    {
      found.FirstNegative = found.Negative++ == 0 ? index + i : found.FirstNegative;
    }
  }
}

// Sets one bit for each cell that has mass.
void markOccupied(const double* values, std::int64_t count, std::uint64_t* words)
{
  for (std::int64_t first = 0; first < count; first += 64)
  {
    const int cells = static_cast<int>(std::min<std::int64_t>(64, count - first));
    std::uint64_t word = 0;
    for (int i = 0; i < cells; ++i)
    {
      word |= static_cast<std::uint64_t>(values[first + i] > 0.0) << i;
    }
    words[first / 64] = word;
  }
}

} // namespace

RowInspection inspectCells(const double* values, std::int64_t count, std::int64_t index,
  std::uint64_t* words, DensitySummary& found)
{
  const RowInspection row = tableKernels().Inspect(values, count);
  found.Maximum = std::max(found.Maximum, row.Largest);
  if (row.Wrong > 0)
  {
    findWrong(values, count, index, found);
  }
  if (row.Smallest > 0.0)
  {
    std::fill_n(words, (count + 63) / 64, ~std::uint64_t{ 0 });
  }
  else
  {
    markOccupied(values, count, words);
  }
  return row;
}

void merge(const DensitySummary& part, DensitySummary& whole)
{
  const auto first = [](std::int64_t a, std::int64_t b) {
    return a < 0 ? b : b < 0 ? a : std::min(a, b);
  };
  whole.NotFinite += part.NotFinite;
  whole.FirstNotFinite = first(whole.FirstNotFinite, part.FirstNotFinite);
  whole.Negative += part.Negative;
  whole.FirstNegative = first(whole.FirstNegative, part.FirstNegative);
  whole.Maximum = std::max(whole.Maximum, part.Maximum);
  whole.Total += part.Total;
}

void requireDensity(const DensitySummary& found)
{
  if (found.NotFinite > 0 || found.Negative > 0 || !(found.Total > 0.0) || std::isinf(found.Total))
  {
    throw InvalidDensity(found);
  }
}

} // namespace RectifiedTransport
