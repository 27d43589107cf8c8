// SPDX-License-Identifier: BSD-3-Clause
// The summed-area tables of a density with their coarse levels (paper, Section 3.3).
#ifndef RectifiedTransport_SummedAreaTables_h
#define RectifiedTransport_SummedAreaTables_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Tables/Density.h"
#include "Core/Tables/TableView.h"

#include <cstdint>
#include <utility>

namespace RectifiedTransport
{

class Progress;

// The memory of tables, for reuse.
struct TableMemory
{
  LargeBuffer<double> Nodes;
  LargeBuffer<std::uint64_t> Occupied; // one bit a cell
};

// One record of doubles a node; see TableView.h for its entries. Built in O(cells), in one pass
// over the density that also inspects it, slab by slab: first the sums of the slab's strips, then
// the tables of all strips in parallel. The strips are fixed: the tables are bitwise the same for
// every executor. Integer-valued densities give exact sums below 2^53.
template <int Dimension>
class SummedAreaTables
{
public:
  // Uses `memory` if it has the right size. Throws InvalidDensity, Cancelled and std::bad_alloc.
  SummedAreaTables(
    const DensitySource<Dimension>& density, Progress& progress, TableMemory memory = {});

  // No other member may be called afterwards.
  TableMemory ReleaseMemory() { return std::move(this->Memory); }

  const TableView<Dimension>& View() const { return this->Tables; }
  const DensitySummary& Summary() const { return this->Found; }
  std::int64_t MemorySize() const
  {
    return this->Memory.Nodes.bytes() + this->Memory.Occupied.bytes();
  }

private:
  void Allocate(const GridSize<Dimension>& size);

  TableMemory Memory;
  TableView<Dimension> Tables;
  DensitySummary Found;
};

} // namespace RectifiedTransport

#endif
