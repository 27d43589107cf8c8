// SPDX-License-Identifier: BSD-3-Clause
// The grid cells under the blocks of a map's samples.
#ifndef RectifiedTransport_BlockCells_h
#define RectifiedTransport_BlockCells_h

#include "Core/Quality/DensityRows.h"
#include "Core/Quality/MapBlocks.h"
#include "Core/Tables/CoveredCells.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
class BlockCells
{
public:
  // For blocks on a lattice over the domain of a grid.
  BlockCells(const GridSize<Dimension>& lattice, const GridSize<Dimension>& grid)
    : Size(grid)
    , Step(latticeStep<Dimension>(lattice, grid))
  {
  }

  // Returns the cells that blocks cover along an axis. A block reaches from the centre of its first
  // sample to that of the fourth after it, hence the 1/2.
  CoveredCells Covered(int axis, std::int64_t block, std::int64_t blocks = 1) const
  {
    constexpr std::int64_t size = MapBlocks<Dimension>::Size;
    const double step = this->Step[axis];
    return { (static_cast<double>(size * block) + 0.5) * step,
      (static_cast<double>(size * (block + blocks)) + 0.5) * step, this->Size[axis] };
  }

  LatticePart<Dimension> Of(const LatticePart<Dimension>& blocks) const
  {
    LatticePart<Dimension> cells{ {}, {} };
    for (int axis = 0; axis < Dimension && !blocks.IsEmpty(); ++axis)
    {
      const CoveredCells covered = this->Covered(axis, blocks.Low[axis], blocks.Cells[axis]);
      cells.Low[axis] = covered.First;
      cells.Cells[axis] = covered.End - covered.First;
    }
    return cells;
  }

  // Adds the mass of a block in the cells of the rows, and the least value of a cell.
  void AddMass(const GridSize<Dimension>& block, const DensityRows<Dimension>& rows, double& mass,
    double& least) const
  {
    GridSize<Dimension> one;
    one.fill(1);
    const LatticePart<Dimension>& held = rows.Cells();
    const LatticePart<Dimension> cells = this->Of({ block, one }).And(held);
    if (cells.IsEmpty())
    {
      return;
    }
    const CoveredCells x = this->Covered(0, block[0]);
    // The cells that are held may be a part of those of the block; other parts come with other
    // batches.
    const double low = std::max(x.Low, static_cast<double>(cells.Low[0]));
    const double high = std::min(x.High, static_cast<double>(cells.End(0)));
    const std::int64_t count = cells.Count() / cells.Cells[0];
    for (std::int64_t i = 0; i < count; ++i)
    {
      const GridSize<Dimension> cell = cells.CellOf(i * cells.Cells[0]);
      double part = 1.0;
      for (int axis = 1; axis < Dimension; ++axis)
      {
        part *= this->Covered(axis, block[axis]).PartOf(cell[axis]);
      }
      const double* row = rows.Row(cell);
      // The mass between two places of a row is a difference of prefix sums.
      mass += part * (rows.Before(row, high) - rows.Before(row, low));
      for (std::int64_t c = cells.Low[0]; c < cells.End(0); ++c)
      {
        least = std::min(least, row[c + 1] - row[c]);
      }
    }
  }

private:
  const GridSize<Dimension> Size;
  const Point<Dimension> Step;
};

} // namespace RectifiedTransport

#endif
