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

// Only the finest level, in the coordinates of the whole domain; one part after another in the same
// memory. The same bits for every executor.
template <int Dimension>
class TileTables
{
public:
  // `whole` are tables of the whole density. The parts take the rest of the view from them, and
  // they must outlive this object. Their values are scaled by 2^scaling.
  TileTables(const TableView<Dimension>& whole, int scaling);

  // Allocates the memory for tables of this number of cells at once; growing from small tables
  // would fragment it. Throws std::bad_alloc.
  void Reserve(const GridSize<Dimension>& cells);

  // Builds the tables of the grid cells from `low` up to `high` of the whole density. Throws
  // Cancelled and std::bad_alloc.
  void Build(const DensityValues& density, const GridSize<Dimension>& low,
    const GridSize<Dimension>& high, Progress& progress);

  const TableView<Dimension>& View() const { return this->Tables; }
  // The bytes of tables of this number of cells.
  static double MemoryFor(const GridSize<Dimension>& cells);

private:
  const int Scaling;
  TableView<Dimension> Tables;
  LargeBuffer<double> Nodes;
  LargeBuffer<std::uint64_t> Occupied; // of the part
};

} // namespace RectifiedTransport

#endif
