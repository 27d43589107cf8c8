// SPDX-License-Identifier: BSD-3-Clause
// Summed-area tables (paper, Section 3.3) of a part of a density.
#ifndef RectifiedTransport_TileTables_h
#define RectifiedTransport_TileTables_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Tables/Density.h"
#include "Core/Tables/TableView.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// The finest level alone, in the coordinates of the whole domain; one part after another in the
// same memory. The same bits for every executor.
template <int Dimension>
class TileTables
{
public:
  // `whole` are tables of the whole density, which the parts have the rest of the view from, and
  // which must outlive this object; values are scaled by 2^scaling in them.
  TileTables(const TableView<Dimension>& whole, int scaling);

  // Takes the memory of the tables of so many cells now: that of small ones after another would be
  // in pieces. Throws std::bad_alloc.
  void Reserve(const GridSize<Dimension>& cells);

  // Builds the tables of the grid cells from `low` up to `high` of the whole density, as the work
  // of the progress's current stage, which has a unit for each of their cells along the last axis.
  // Throws Cancelled and std::bad_alloc.
  void Build(const DensityValues& density, const GridSize<Dimension>& low,
    const GridSize<Dimension>& high, Progress& progress);

  const TableView<Dimension>& View() const { return this->Tables; }
  // The bytes of the tables of so many cells.
  static double MemoryFor(const GridSize<Dimension>& cells);

private:
  const int Scaling;
  TableView<Dimension> Tables;
  LargeBuffer<double> Nodes;
  LargeBuffer<std::uint64_t> Occupied; // of the part
};

} // namespace RectifiedTransport

#endif
