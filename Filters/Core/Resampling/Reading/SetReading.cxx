// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/Reading/SetReading.h"

#include "Core/Parallel/Progress.h"
#include "Core/Tables/Reading/DensityFailure.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t readingGrain = std::int64_t{ 1 } << 14;
constexpr unsigned char unused = 1; // flags values that are not read

// A byte for each value, 1 if it is missing; empty if none can be.
std::vector<unsigned char> findMissing(
  const DensityReader& reader, std::int64_t count, Progress& progress)
{
  std::vector<unsigned char> missing;
  if (reader.GetRules().Missing.Are())
  {
    missing.resize(static_cast<std::size_t>(count));
    progress.For(count, readingGrain, [&](std::int64_t first, std::int64_t last) {
      reader.FindEmpty(first, last - first, missing.data() + first);
    });
  }
  return missing;
}

} // namespace

// Values that no counted cell needs are blank for the reader: they become 0 and cause no error.
SetReading::SetReading(std::unique_ptr<DensityReader> reader, const std::string& name,
  bool areBytes, const std::shared_ptr<const CellSet>& set, bool onPoints, const MassCells& mass,
  Progress& progress)
  : Reader(std::move(reader))
  , AreBytes(areBytes)
{
  const std::int64_t count = onPoints ? set->NumberOfPoints : set->NumberOfCells;
  this->Cells = CellValues(
    set, mass, onPoints, findMissing(*this->Reader, count, progress), this->Unused, progress);
  this->Reader->SetBlanks(this->Unused.data(), unused);
  this->Found.Array = name;
}

// The white of byte images depends on all sets, so that it is found before any is read.
double SetReading::FindLargest(Progress& progress)
{
  this->Found.Known.White =
    findWhite(*this->Reader, this->AreBytes, this->NumberOfValues(), progress);
  return this->Found.Known.White.Value;
}

// The least is that of the values that counted cells need, as blank ones are 0.
void SetReading::Read(LargeBuffer<double> densities, Progress& progress)
{
  const std::int64_t count = this->NumberOfValues();
  const DensityRules& rules = this->Reader->GetRules();
  double* values = densities.data();
  progress.For(count, readingGrain, [&](std::int64_t first, std::int64_t last) {
    this->Reader->Read(first, last - first, values + first);
  });
  // Blank values are 0 by now and pass.
  const DensitySummary found = summarize(values, count, 0);
  if (found.NotFinite > 0 || found.Negative > 0)
  {
    throwInvalidDensity(this->Found.Array, found, rules.Missing);
  }
  this->Found.Known.Found = found;
  for (std::int64_t i = 0; i < count; ++i)
  {
    if (this->Unused[static_cast<std::size_t>(i)] == 0)
    {
      this->Found.Least = std::min(this->Found.Least, values[i]);
    }
  }
  if (rules.ClampNegative && !rules.Invert)
  {
    this->Found.Known.Clamped = findLowest(*this->Reader, count, progress);
  }
  this->Cells.SetValues(std::move(densities));
}

} // namespace RectifiedTransport
