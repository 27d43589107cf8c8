// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/DensityInspection.h"

#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

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

// Updates the smallest, the largest and the second largest value of `found` by those of a row. Only
// a row that reaches the largest value so far is counted; in another row the largest value is
// merely a candidate for the second largest.
void inspectLargest(const double* values, std::int64_t count, std::int64_t index, double least,
  double largest, DensitySummary& found)
{
  found.Minimum = std::min(found.Minimum, least);
  if (!(largest > 0.0) || largest < found.Maximum)
  {
    found.BelowMaximum = std::max(found.BelowMaximum, largest);
    return;
  }
  // A new maximum: the previous one becomes the candidate for the second largest value, and
  // counting begins again.
  if (largest > found.Maximum)
  {
    found.BelowMaximum = found.Maximum;
    found.Maximum = largest;
    found.Maxima = 0;
    found.FirstMaximum = index + (std::find(values, values + count, largest) - values);
  }
  const RowMaximum row = tableKernels().Largest(values, count, largest);
  found.Maxima += row.Count;
  found.BelowMaximum = std::max(found.BelowMaximum, row.Below);
}

// Inspects part of a row of grid cells, beginning at the index `index`.
RowInspection inspect(
  const double* values, std::int64_t count, std::int64_t index, DensitySummary& found)
{
  // One pass gives sum, moment, extremes and the number of wrong values.
  const RowInspection row = tableKernels().Inspect(values, count);
  inspectLargest(values, count, index, row.Smallest, row.Largest, found);
  // The kernel only counts wrong values; their places are searched if there are any.
  if (row.Wrong > 0)
  {
    findWrong(values, count, index, found);
  }
  return row;
}

} // namespace

RowInspection inspectCells(const double* values, std::int64_t count, std::int64_t index,
  std::uint64_t* words, DensitySummary& found)
{
  const RowInspection row = inspect(values, count, index, found);
  if (row.Smallest > 0.0)
  {
    // The bits beyond the row's end are set, too, so that a full density has nothing but full
    // words.
    std::fill_n(words, (count + 63) / 64, ~std::uint64_t{ 0 });
  }
  else
  {
    markOccupied(values, count, words);
  }
  return row;
}

DensitySummary summarize(const double* values, std::int64_t count, std::int64_t index)
{
  DensitySummary found;
  if (count > 0)
  {
    // Values that are not finite make the total not finite, too, and are reported by their own
    // count.
    found.Total = std::accumulate(values, values + count, 0.0);
    inspect(values, count, index, found);
  }
  return found;
}

void merge(const DensitySummary& part, DensitySummary& whole)
{
  // The smaller of two indices, of which -1 means none.
  const auto first = [](std::int64_t a, std::int64_t b) {
    return a < 0 ? b : b < 0 ? a : std::min(a, b);
  };
  whole.NotFinite += part.NotFinite;
  whole.FirstNotFinite = first(whole.FirstNotFinite, part.FirstNotFinite);
  whole.Negative += part.Negative;
  whole.FirstNegative = first(whole.FirstNegative, part.FirstNegative);
  // The second largest value of both parts: the loser's maximum competes with the winner's second.
  if (part.Maximum > whole.Maximum)
  {
    whole.BelowMaximum = std::max(whole.Maximum, part.BelowMaximum);
    whole.Maximum = part.Maximum;
    whole.Maxima = part.Maxima;
    whole.FirstMaximum = part.FirstMaximum;
  }
  else if (part.Maximum == whole.Maximum)
  {
    whole.BelowMaximum = std::max(whole.BelowMaximum, part.BelowMaximum);
    whole.Maxima += part.Maxima;
    whole.FirstMaximum = first(whole.FirstMaximum, part.FirstMaximum);
  }
  else
  {
    whole.BelowMaximum = std::max(whole.BelowMaximum, part.Maximum);
  }
  whole.Minimum = std::min(whole.Minimum, part.Minimum);
  whole.Total += part.Total;
}

DensitySummary summarize(const DensityValues& density, std::int64_t count, Progress& progress)
{
  // Chunks are fixed and merged in their order, so that the total has the same bits for any
  // number of threads.
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const auto readChunk = [&](std::int64_t first, std::int64_t last) {
    std::vector<double> values(static_cast<std::size_t>(last - first));
    density.Read(first, last - first, values.data());
    return summarize(values.data(), last - first, first);
  };
  const auto join = [](DensitySummary all, const DensitySummary& chunk) {
    merge(chunk, all);
    return all;
  };
  return reduceChunks(progress, count, grain, DensitySummary(), readChunk, join);
}

void requireDensity(const DensitySummary& found)
{
  if (found.NotFinite > 0 || found.Negative > 0 || !(found.Total > 0.0) || std::isinf(found.Total))
  {
    throw InvalidDensity(found);
  }
}

} // namespace RectifiedTransport
