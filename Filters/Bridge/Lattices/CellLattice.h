// SPDX-License-Identifier: BSD-3-Clause
// The cells of an image that have become voxels, hexahedra, pixels, quadrilaterals or lines, as by
// Threshold: the image that they are of.
#ifndef RectifiedTransport_CellLattice_h
#define RectifiedTransport_CellLattice_h

#include "Bridge/Blocks/BlockValues.h"
#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Lattices/LatticeFrame.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class CellLattice
{
public:
  // Of the cells of the dimension. None where one of them is no box of the lattice of the first
  // one, in any order of its corners and in any direction of its axes, and where far fewer cells
  // than the lattice's box has are there. Corners may be off by what single precision rounds them,
  // and by 1e-4 of a cell. Throws Failure and Cancelled.
  static std::optional<CellLattice> Find(
    const std::vector<DensityBlock>& blocks, int dimension, Progress& progress);

  // Values on cells, on the box of the cells of all blocks. The axes are those of space, or nearest
  // to them.
  const ImageGrid& Grid() const { return this->Box; }

  // The grid with each of its cells divided so often along each axis that it has about `resolution`
  // along its longest one, or as it is.
  ImageGrid DividedGrid(int resolution) const;

  // Whether no two of the cells that count are in one place. The values are those of the blocks in
  // Find that have an array, in their order.
  bool HasEachOnce(const std::vector<BlockValues>& values, Progress& progress) const;
  // The grid with the cell values in their places, 0 where there is none. Throws Failure.
  vtkSmartPointer<vtkImageData> MakeImage(
    const std::vector<BlockValues>& values, const char* name, Progress& progress) const;
  // Sets to 0 what rounding put outside the cells, in an image of the divided grid.
  void ClearAround(const std::vector<BlockValues>& values, const ImageGrid& divided, double* cells,
    Progress& progress) const;

  // Calls visit(place, block, cell) for the cells that count; a place is a number in the grid.
  template <class Visit>
  void VisitCounted(
    const std::vector<BlockValues>& values, Progress& progress, const Visit& visit) const;

  const LatticeFrame& Frame() const { return this->Axes; }

private:
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

} // namespace RectifiedTransport

#endif
