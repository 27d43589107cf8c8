// SPDX-License-Identifier: BSD-3-Clause
// A box of the cells of a lattice.
#ifndef RectifiedTransport_LatticePart_h
#define RectifiedTransport_LatticePart_h

#include "Core/Geometry/GridSize.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
struct LatticePart
{
  GridSize<Dimension> Low{};
  GridSize<Dimension> Cells;

  static LatticePart WholeOf(const GridSize<Dimension>& lattice) { return { {}, lattice }; }

  std::int64_t Count() const
  {
    std::int64_t count = 1;
    for (const std::int64_t cells : this->Cells)
    {
      count *= cells;
    }
    return count;
  }
  // The lattice's cell of a number in the part, axis 0 fastest.
  GridSize<Dimension> CellOf(std::int64_t number) const
  {
    GridSize<Dimension> cell;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      cell[axis] = this->Low[axis] + number % this->Cells[axis];
      number /= this->Cells[axis];
    }
    return cell;
  }
  // The number in the part of one of its cells.
  std::int64_t NumberOf(const GridSize<Dimension>& cell) const
  {
    std::int64_t number = 0;
    for (int axis = Dimension; axis-- > 0;)
    {
      number = number * this->Cells[axis] + (cell[axis] - this->Low[axis]);
    }
    return number;
  }
  bool Contains(const GridSize<Dimension>& cell) const
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      if (cell[axis] < this->Low[axis] || cell[axis] >= this->Low[axis] + this->Cells[axis])
      {
        return false;
      }
    }
    return true;
  }
  bool Contains(const LatticePart& other) const
  {
    return this->With(other).Count() == this->Count();
  }
  // The smallest part that contains both.
  LatticePart With(const LatticePart& other) const
  {
    if (this->Count() == 0 || other.Count() == 0)
    {
      return other.Count() == 0 ? *this : other;
    }
    LatticePart both;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      both.Low[axis] = std::min(this->Low[axis], other.Low[axis]);
      both.Cells[axis] =
        std::max(this->Low[axis] + this->Cells[axis], other.Low[axis] + other.Cells[axis]) -
        both.Low[axis];
    }
    return both;
  }
  // The part with one more layer of cells on each side, where the lattice has them.
  LatticePart Around(const GridSize<Dimension>& lattice) const
  {
    if (this->Count() == 0)
    {
      return *this;
    }
    LatticePart around;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      around.Low[axis] = std::max<std::int64_t>(0, this->Low[axis] - 1);
      around.Cells[axis] =
        std::min(lattice[axis], this->Low[axis] + this->Cells[axis] + 1) - around.Low[axis];
    }
    return around;
  }
};

} // namespace RectifiedTransport

#endif
