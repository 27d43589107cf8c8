// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/CellValues.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>

namespace RectifiedTransport
{

CellValues::CellValues(std::shared_ptr<const CellSet> cells, const MassCells& mass, bool onPoints,
  const std::vector<unsigned char>& missing, std::vector<unsigned char>& unused, Progress& progress)
  : Set(std::move(cells))
  , Mass(mass)
  , OnPoints(onPoints)
  , Roles(static_cast<std::size_t>(this->Set->NumberOfCells), NotCounted)
{
  constexpr std::int64_t cellsBetweenPolls = std::int64_t{ 1 } << 16;
  unused.assign(static_cast<std::size_t>(this->NumberOfValues()), 1);
  const auto isMissing = [&missing](std::int64_t value) {
    return !missing.empty() && missing[static_cast<std::size_t>(value)] != 0;
  };
  const auto reader = this->Set->Read();
  for (std::int64_t cell = 0; cell < this->Set->NumberOfCells; ++cell)
  {
    if (cell % cellsBetweenPolls == 0)
    {
      progress.Check();
    }
    if (!mass.HasDimension(*reader, cell) || this->Set->HiddenCells.Has(cell) ||
      (!onPoints && isMissing(cell)))
    {
      continue;
    }
    if (mass.AreClosedLines && !mass.Find(*reader, cell))
    {
      this->FirstOpen = this->Open++ == 0 ? cell : this->FirstOpen;
      continue;
    }
    const CellReader::Ids none;
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

template <class Change>
CellValues CellValues::Changed(const Change& change) const
{
  CellValues changed;
  changed.Set = this->Set;
  changed.Mass = this->Mass;
  changed.OnPoints = this->OnPoints;
  changed.Open = this->Open;
  changed.FirstOpen = this->FirstOpen;
  changed.Density = LargeBuffer<double>(this->Density.size());
  changed.Roles = this->Roles;
  std::transform(this->Density.data(), this->Density.data() + this->Density.size(),
    changed.Density.data(), change);
  return changed;
}

CellValues CellValues::Only(double value) const
{
  return this->Changed([value](double density) { return density == value ? density : 0.0; });
}

CellValues CellValues::Ground() const
{
  // Closed lines are told apart by their values.
  const bool areLines = this->AreClosedLines();
  CellValues ground = this->Changed([=](double density) { return areLines ? density : 1.0; });
  ground.IsGround = true;
  return ground;
}

} // namespace RectifiedTransport
