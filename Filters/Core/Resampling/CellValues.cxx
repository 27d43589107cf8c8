// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/CellValues.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>

namespace RectifiedTransport
{

// The roles follow from dimension, visibility and missing values. Values that only cells without a
// role would need are not read.
CellValues::CellValues(std::shared_ptr<const CellSet> cells, const MassCells& mass, bool onPoints,
  const std::vector<unsigned char>& missing, std::vector<unsigned char>& unused, Progress& progress)
  : Set(std::move(cells))
  , Mass(mass)
  , OnPoints(onPoints)
  , Roles(std::make_shared<std::vector<Role>>(
      static_cast<std::size_t>(this->Set->NumberOfCells), NotCounted))
{
  constexpr std::int64_t cellsBetweenPolls = std::int64_t{ 1 } << 16;
  unused.assign(static_cast<std::size_t>(this->NumberOfValues()), 1);
  const auto isMissing = [&missing](std::int64_t value) {
    return !missing.empty() && missing[static_cast<std::size_t>(value)] != 0;
  };
  const auto reader = this->Set->Read();
  for (std::int64_t cell = 0; cell < this->Set->NumberOfCells; ++cell)
  {
    progress.CheckEvery(cellsBetweenPolls, cell);
    // Cells of a lower dimension have no measure in the domain.
    if (!mass.HasDimension(*reader, cell) || this->Set->HiddenCells.Has(cell) ||
      (!onPoints && isMissing(cell)))
    {
      continue;
    }
    if (mass.AreClosedLines && !mass.Find(*reader, cell))
    {
      // The first such line is named in the warning.
      this->FirstOpen = this->Open++ == 0 ? cell : this->FirstOpen;
      continue;
    }
    const CellReader::Ids none;
    // Reading a cell's points takes most of the time; without point values or hidden points it is
    // spared.
    const bool needsPoints = onPoints || this->Set->HiddenPoints.Flags;
    const CellReader::Ids& points = needsPoints ? reader->PointsOf(cell) : none;
    if (this->Set->HiddenPoints.HasAny(points) ||
      (onPoints && std::any_of(points.begin(), points.end(), isMissing)))
    {
      continue;
    }
    this->RoleOf(cell) = mass.AreClosedLines ? Region : Divided;
    if (!onPoints)
    {
      unused[static_cast<std::size_t>(cell)] = 0;
      continue;
    }
    for (const std::int64_t point : points)
    {
      unused[static_cast<std::size_t>(point)] = 0;
    }
  }
}

// Copies share values and roles; only the rule for At() changes.
CellValues CellValues::Only(double value) const
{
  CellValues only = *this;
  only.HasOnly = true;
  only.OnlyValue = value;
  return only;
}

CellValues CellValues::Ground() const
{
  CellValues ground = *this;
  ground.IsGround = true;
  return ground;
}

} // namespace RectifiedTransport
