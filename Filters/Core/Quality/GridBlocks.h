// SPDX-License-Identifier: BSD-3-Clause
// Blocks of grid cells, axis 0 fastest; the last block along an axis may have fewer.
#ifndef RectifiedTransport_GridBlocks_h
#define RectifiedTransport_GridBlocks_h

#include "Core/Geometry/GridSize.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// Grid cells from Low up to High.
template <int Dimension>
struct GridBox
{
  GridSize<Dimension> Low;
  GridSize<Dimension> High;

  double Cells() const
  {
    double cells = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      cells *= static_cast<double>(this->High[axis] - this->Low[axis]);
    }
    return cells;
  }
};

template <int Dimension>
class GridBlocks
{
public:
  // `blockSize` grid cells along each axis.
  GridBlocks(const GridSize<Dimension>& cells, std::int64_t blockSize)
    : Size(cells)
    , BlockSize(blockSize)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Counts[axis] = (cells[axis] - 1) / blockSize + 1;
    }
  }

  // A double, because it may exceed every integer.
  double Count() const { return numberOfCells<Dimension>(this->Counts); }

  // The block of a position in the grid.
  std::int64_t At(const Point<Dimension>& index) const
  {
    std::int64_t block = 0;
    for (int axis = Dimension; axis-- > 0;)
    {
      const auto cell = std::min(static_cast<std::int64_t>(index[axis]), this->Size[axis] - 1);
      block = block * this->Counts[axis] + cell / this->BlockSize;
    }
    return block;
  }

  GridBox<Dimension> Box(std::int64_t block) const
  {
    GridBox<Dimension> box;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      box.Low[axis] = block % this->Counts[axis] * this->BlockSize;
      box.High[axis] = std::min(box.Low[axis] + this->BlockSize, this->Size[axis]);
      block /= this->Counts[axis];
    }
    return box;
  }

private:
  const GridSize<Dimension> Size;
  const std::int64_t BlockSize;
  GridSize<Dimension> Counts;
};

} // namespace RectifiedTransport

#endif
