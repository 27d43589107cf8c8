// SPDX-License-Identifier: BSD-3-Clause
// Cells of an image that a filter such as Threshold turned into voxels, hexahedra, pixels,
// quadrilaterals or lines: the image that they came from.
#ifndef RectifiedTransport_CellLattice_h
#define RectifiedTransport_CellLattice_h

#include "Bridge/Blocks/BlockValues.h"
#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Lattices/LatticeFrame.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace RectifiedTransport::Bridge
{

class CellLattice
{
public:
  // The lattice of the cells of the dimension. None if a cell is not a box of the lattice of the
  // first one, for any order of corners and direction of axes, or if there are far fewer cells than
  // the lattice's box has. Corners may be off by the rounding of single precision and by 1e-4 of a
  // cell. Throws Failure and Cancelled.
  static std::optional<CellLattice> Find(
    const std::vector<DensityBlock>& blocks, int dimension, Progress& progress);

  // The grid on the box of the cells of all blocks, with values on cells. Its axes are those of
  // space, or nearest to them.
  const ImageGrid& Grid() const { return this->Box; }

  // The grid with its cells divided along each axis so that the longest axis has about `resolution`
  // cells, or the grid as it is.
  ImageGrid DividedGrid(int resolution) const;

  // Whether no two counted cells are at the same place. The values are those of the blocks in Find
  // that have an array, in their order.
  bool HasEachOnce(const std::vector<BlockValues>& values, Progress& progress) const;
  // For the grid: the cell values in their places, 0 if there is none.
  void CopyValues(const std::vector<BlockValues>& values, double* cells, Progress& progress) const;
  // For the divided grid: sets to 0 what rounding put outside the cells.
  void ClearAround(const std::vector<BlockValues>& values, const ImageGrid& divided, double* cells,
    Progress& progress) const;

  // Calls visit(place, block, cell) for the counted cells; a place is a number in the grid.
  template <class Visit>
  void VisitCounted(
    const std::vector<BlockValues>& values, Progress& progress, const Visit& visit) const;

  const LatticeFrame& Frame() const { return this->Axes; }

private:
  // Which places have a counted cell. Returns whether none has two.
  bool FindTaken(
    const std::vector<BlockValues>& values, Progress& progress, std::vector<bool>& taken) const;

  LatticeFrame Axes;
  ImageGrid Box;
  std::vector<std::vector<std::int64_t>> Places; // of the cells of each block; -1: none
};

template <class Visit>
void CellLattice::VisitCounted(
  const std::vector<BlockValues>& values, Progress& progress, const Visit& visit) const
{
  constexpr std::size_t cellsBetweenPolls = std::size_t{ 1 } << 16;
  for (std::size_t b = 0; b < values.size(); ++b)
  {
    const std::vector<std::int64_t>& places = this->Places[b];
    for (std::size_t cell = 0; cell < places.size(); ++cell)
    {
      if (cell % cellsBetweenPolls == 0)
      {
        progress.Check();
      }
      if (places[cell] >= 0 && values[b].IsCounted(static_cast<vtkIdType>(cell)))
      {
        visit(places[cell], b, cell);
      }
    }
  }
}

} // namespace RectifiedTransport::Bridge

#endif
