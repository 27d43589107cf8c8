// SPDX-License-Identifier: BSD-3-Clause
// The density of a data set's cells, and which of them carry mass.
#ifndef RectifiedTransport_CellValues_h
#define RectifiedTransport_CellValues_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Resampling/MassCells.h"
#include "Core/Tables/DensityInspection.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

class Progress;

class CellValues
{
public:
  CellValues() = default;
  // Makes an object without values. Cells count if they carry mass and neither they nor their
  // points are hidden or lack a valid value. `missing` says which values are not valid; if it is
  // empty, all are. Sets `unused` to 1 for each value that no counted cell needs, to 0 for the
  // others. Throws Cancelled.
  CellValues(std::shared_ptr<const CellSet> cells, const MassCells& mass, bool onPoints,
    const std::vector<unsigned char>& missing, std::vector<unsigned char>& unused,
    Progress& progress);

  const CellSet& Cells() const { return *this->Set; }
  // Takes another set of the same points and cells.
  void SetCells(std::shared_ptr<const CellSet> cells) { this->Set = std::move(cells); }
  bool IsOnPoints() const { return this->OnPoints; }
  // There is one for each point or cell.
  std::int64_t NumberOfValues() const
  {
    return this->OnPoints ? this->Set->NumberOfPoints : this->Set->NumberOfCells;
  }
  // One for each point or cell; 0 where no counted cell needs it.
  void SetValues(LargeBuffer<double> values)
  {
    this->Density = std::make_shared<const LargeBuffer<double>>(std::move(values));
  }
  double At(std::int64_t pointOrCell) const
  {
    const double value = this->Density->data()[pointOrCell];
    return this->IsGround ? (this->AreClosedLines() ? value : 1.0)
      : this->HasOnly     ? (value == this->OnlyValue ? value : 0.0)
                          : value;
  }
  double At(std::int64_t point, std::int64_t cell) const
  {
    return this->At(this->OnPoints ? point : cell);
  }

  // The same cells with the density only where it is `value`. They share their memory.
  CellValues Only(double value) const;
  // The same cells with the density 1, which measures what they cover. Closed lines are told apart
  // by their values all the same.
  CellValues Ground() const;
  // The density of a region: the one that was found by its values, or 1 of ground.
  double OfRegion(double density) const { return this->IsGround ? 1.0 : density; }

  bool IsCounted(std::int64_t cell) const { return this->RoleOf(cell) != NotCounted; }
  // Counted cells are regions within their outlines, or are divided into simplices and boxes.
  bool IsRegion(std::int64_t cell) const { return this->RoleOf(cell) >= Region; }
  bool IsDivided(std::int64_t cell) const { return this->RoleOf(cell) == Divided; }
  void MarkAsRegion(std::int64_t cell) { this->RoleOf(cell) = Region; }
  // Regions whose outline is known not to cross itself. The first visit finds out, each region on
  // one thread.
  bool IsSimple(std::int64_t cell) const { return this->RoleOf(cell) == SimpleRegion; }
  void MarkAsSimple(std::int64_t cell) const { this->RoleOf(cell) = SimpleRegion; }
  // Whether the cells are closed lines, which are around regions together.
  bool AreClosedLines() const { return this->Mass.AreClosedLines; }
  // The number of lines that are not closed, if the others are around regions.
  std::int64_t OpenLines() const { return this->Open; }
  std::int64_t FirstOpenLine() const { return this->FirstOpen; } // its cell, or -1

private:
  enum Role : unsigned char
  {
    NotCounted,
    Divided,
    Region,
    SimpleRegion
  };
  Role& RoleOf(std::int64_t cell) const { return (*this->Roles)[static_cast<std::size_t>(cell)]; }

  std::shared_ptr<const CellSet> Set;
  MassCells Mass;
  bool OnPoints = false;
  bool IsGround = false;
  bool HasOnly = false;
  double OnlyValue = 0.0;
  std::shared_ptr<const LargeBuffer<double>> Density;
  std::shared_ptr<std::vector<Role>> Roles; // by cells; shared by copies
  std::int64_t Open = 0;                    // number of lines that are not closed
  std::int64_t FirstOpen = -1;
};

} // namespace RectifiedTransport

#endif
