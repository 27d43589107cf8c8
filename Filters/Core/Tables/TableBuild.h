// SPDX-License-Identifier: BSD-3-Clause
// The pass that fills the summed-area tables (paper, Section 3.3; Algorithm 2).
#ifndef RectifiedTransport_TableBuild_h
#define RectifiedTransport_TableBuild_h

#include "Core/Tables/Density.h"
#include "Core/Tables/TableView.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

template <int Dimension>
struct TableBuild
{
  const DensityValues& Density;
  Progress& Work;
  const TableView<Dimension>& Tables;
  double* Nodes; // nodes of all levels
  std::uint64_t* Occupied;
  DensitySummary& Found;
  GridSize<Dimension> Origin = {}; // moments are about the origin of the grid, whose cell this is

  // Returns the writable nodes of a level, which are in the same memory as those of level 0.
  double* Level(int level) const
  {
    return this->Nodes + (this->Tables.Levels[level].Nodes - this->Tables.Levels[0].Nodes);
  }
};

// Fills all levels and the bits of occupied cells, and adds to `Found`. Throws Cancelled.
void buildTables(const TableBuild<1>& build);
void buildTables(const TableBuild<2>& build);
void buildTables(const TableBuild<3>& build);

} // namespace RectifiedTransport

#endif
