// SPDX-License-Identifier: BSD-3-Clause
// The values of the densities of data sets, and which of their cells carry mass.
#ifndef RectifiedTransport_BlockValues_h
#define RectifiedTransport_BlockValues_h

#include "Bridge/Blocks/MassCells.h"
#include "Bridge/Density/DensityReader.h"
#include "Bridge/Density/UnusualValues.h"
#include "Core/Parallel/LargeBuffer.h"

#include "vtkDataSet.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class BlockValues
{
public:
  vtkDataSet* Data() const { return this->Set; }
  // Takes another data set of the same points and cells, which may have other arrays.
  void SetData(vtkDataSet* data) { this->Set = data; }
  bool IsOnPoints() const { return this->OnPoints; }
  // Values of the points or the cells; 0 where no counted cell needs them.
  const double* Values() const { return this->Density.data(); }
  std::int64_t NumberOfValues() const { return this->Density.size(); }
  // What messages call the array.
  const std::string& Name() const { return this->ArrayName; }
  // What is known of the values, with the white of this block.
  const UnusualValues& Unusual() const { return this->Known; }
  // The same cells with the density only where it is `value`. Throws Failure if memory is short.
  BlockValues Only(double value) const;
  // The same cells with the density 1, which measures what they cover. Throws as Only.
  BlockValues Ground() const;
  // The density of a region: the one that was found by its values, or 1 of ground.
  double OfRegion(double density) const { return this->IsGround ? 1.0 : density; }
  // The least value of counted cells; infinite if there is none.
  double Least() const { return this->LeastCounted; }
  bool IsCounted(vtkIdType cell) const { return this->RoleOf(cell) != NotCounted; }
  // Counted cells are regions within their outlines, or are divided into simplices and boxes.
  bool IsRegion(vtkIdType cell) const { return this->RoleOf(cell) >= Region; }
  bool IsDivided(vtkIdType cell) const { return this->RoleOf(cell) == Divided; }
  void MarkAsRegion(vtkIdType cell) { this->RoleOf(cell) = Region; }
  // Regions whose outline is known not to cross itself. The first visit finds out, each region on
  // one thread.
  bool IsSimple(vtkIdType cell) const { return this->RoleOf(cell) == SimpleRegion; }
  void MarkAsSimple(vtkIdType cell) const { this->RoleOf(cell) = SimpleRegion; }
  // Whether the cells are closed lines, which are around regions together.
  bool AreClosedLines() const { return this->Cells.AreClosedLines; }
  // The number of lines that are not closed, if the others are around regions.
  vtkIdType OpenLines() const { return this->Open; }
  vtkIdType FirstOpenLine() const { return this->FirstOpen; } // its cell, or -1
  // What messages call the block.
  const std::string& BlockName() const { return this->NameOfBlock; }

private:
  friend class BlockReading;

  template <class Change>
  BlockValues Changed(const Change& change) const;

  enum Role : unsigned char
  {
    NotCounted,
    Divided,
    Region,
    SimpleRegion
  };
  Role& RoleOf(vtkIdType cell) const { return this->Roles[static_cast<std::size_t>(cell)]; }

  vtkSmartPointer<vtkDataSet> Set;
  bool OnPoints = false;
  std::string ArrayName;
  UnusualValues Known;
  double LeastCounted = std::numeric_limits<double>::infinity();
  bool IsGround = false;
  LargeBuffer<double> Density;
  mutable std::vector<Role> Roles; // of the cells
  MassCells Cells;
  vtkIdType Open = 0;
  vtkIdType FirstOpen = -1;
  std::string NameOfBlock;
};

// What the property Component takes of blocks that all have an array: an index, Luminance or
// Magnitude. Throws Failure if a block does not have it, or Auto takes different ones of several
// components.
int takenComponent(const std::vector<DensityBlock>& blocks, int component);

// Cells count if they carry mass and neither they nor their points are blanked or without a valid
// value. Throws Failure for values of counted cells that are no density, and Cancelled.
std::vector<BlockValues> readBlocks(const std::vector<DensityBlock>& blocks, bool onPoints,
  const MassCells& cells, const DensityRules& rules, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
