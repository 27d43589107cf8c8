// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/Reading/DensityReader.h"

#include "Core/Parallel/Reduction.h"

#include <vector>

namespace RectifiedTransport
{

namespace
{

// Chunks are fixed, so that findings are merged in the same order for any number of threads.
constexpr std::int64_t grain = std::int64_t{ 1 } << 14;

template <class Found>
Found merged(Found all, const Found& part)
{
  merge(part, all);
  return all;
}

} // namespace

// Negative values are clamped before empty cells get their density, which is never negative.
void DensityReader::Finish(std::int64_t first, std::int64_t count, double* values) const
{
  if (this->Rules.ClampNegative)
  {
    // Minus infinity remains, and is reported as an error.
    constexpr double lowest = std::numeric_limits<double>::lowest();
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] = values[i] < 0.0 && values[i] >= lowest ? 0.0 : values[i];
    }
  }
  if (this->Flags)
  {
    const unsigned char* flags = this->Flags + first;
    const unsigned char mask = this->Mask;
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] = (flags[i] & mask) ? this->Empty : values[i];
    }
  }
}

// White is what Invert subtracts values from. Bytes are displayed from 0 to 255.
LargestValue findWhite(
  const DensityReader& reader, bool areBytes, std::int64_t count, Progress& progress)
{
  if (areBytes && reader.GetRules().Component != Magnitude)
  {
    LargestValue displayed;
    displayed.Value = std::numeric_limits<unsigned char>::max();
    return displayed;
  }
  // Without any finite value there is no white, and the construction of the tables reports the
  // error.
  const auto ofChunk = [&reader](std::int64_t first, std::int64_t last) {
    return reader.Largest(first, last - first);
  };
  return reduceChunks(progress, count, grain, LargestValue(), ofChunk, merged<LargestValue>);
}

// Finds what ClampNegative hides, by a reader that does not clamp.
LowestValue findLowest(const DensityReader& reader, std::int64_t count, Progress& progress)
{
  const std::unique_ptr<DensityReader> unclamped = reader.MakeUnclamped();
  const auto ofChunk = [&](std::int64_t first, std::int64_t last) {
    std::vector<double> values(static_cast<std::size_t>(last - first));
    unclamped->Read(first, last - first, values.data());
    LowestValue found;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const double value = values[i];
      found.Largest = std::isfinite(value) ? std::max(found.Largest, value) : found.Largest;
      if (!(value < 0.0) || !std::isfinite(value))
      {
        continue;
      }
      found.Negative += value;
      if (value < found.Value)
      {
        found.Value = value;
        found.Count = 0;
        found.First = first + static_cast<std::int64_t>(i);
      }
      found.Count += value == found.Value ? 1 : 0;
    }
    return found;
  };
  return reduceChunks(progress, count, grain, LowestValue(), ofChunk, merged<LowestValue>);
}

} // namespace RectifiedTransport
