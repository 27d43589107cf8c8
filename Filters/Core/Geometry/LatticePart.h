// SPDX-License-Identifier: BSD-3-Clause
// Boxes of the cells of a lattice.
#ifndef RectifiedTransport_LatticePart_h
#define RectifiedTransport_LatticePart_h

#include "GridSize.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// A box of cells: [Low, Low + Cells) along each axis.
template <int Dimension>
struct LatticePart
{
  GridSize<Dimension> Low{};
  GridSize<Dimension> Cells;

  static LatticePart WholeOf(const GridSize<Dimension>& lattice) { return { {}, lattice }; }

  // Where it ends along an axis: the cell after its last one.
  std::int64_t End(int axis) const { return this->Low[axis] + this->Cells[axis]; }
  bool IsEmpty() const
  {
    return std::any_of(
      this->Cells.begin(), this->Cells.end(), [](std::int64_t cells) { return cells <= 0; });
  }

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
      if (cell[axis] < this->Low[axis] || cell[axis] >= this->End(axis))
      {
        return false;
      }
    }
    return true;
  }
  // True if the other adds nothing to the box around both.
  bool Contains(const LatticePart& other) const
  {
    return this->With(other).Count() == this->Count();
  }
  // The smallest part that contains both.
  LatticePart With(const LatticePart& other) const
  {
    if (this->IsEmpty() || other.IsEmpty())
    {
      return other.IsEmpty() ? *this : other;
    }
    LatticePart both;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      both.Low[axis] = std::min(this->Low[axis], other.Low[axis]);
      both.Cells[axis] = std::max(this->End(axis), other.End(axis)) - both.Low[axis];
    }
    return both;
  }
  // What both contain.
  LatticePart And(const LatticePart& other) const
  {
    LatticePart both;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      both.Low[axis] = std::max(this->Low[axis], other.Low[axis]);
      both.Cells[axis] =
        std::max<std::int64_t>(0, std::min(this->End(axis), other.End(axis)) - both.Low[axis]);
    }
    return both;
  }
  // The part with one more layer of cells on each side, if the lattice has them.
  LatticePart Around(const GridSize<Dimension>& lattice) const
  {
    if (this->IsEmpty())
    {
      return *this;
    }
    LatticePart around;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      around.Low[axis] = std::max<std::int64_t>(0, this->Low[axis] - 1);
      around.Cells[axis] = std::min(lattice[axis], this->End(axis) + 1) - around.Low[axis];
    }
    return around;
  }
};

// The `count` cells of a lattice from number `first` on, axis 0 fastest, as boxes of consecutive
// cells.
template <int Dimension>
std::vector<LatticePart<Dimension>> partsOf(
  const GridSize<Dimension>& lattice, std::int64_t first, std::int64_t count)
{
  std::vector<LatticePart<Dimension>> parts;
  while (count > 0)
  {
    // As many whole layers as possible, of as many axes as possible.
    LatticePart<Dimension> part{ LatticePart<Dimension>::WholeOf(lattice).CellOf(first), {} };
    part.Cells.fill(1);
    int axis = 0;
    std::int64_t layer = 1;
    while (axis + 1 < Dimension && part.Low[axis] == 0 && count >= layer * lattice[axis])
    {
      part.Cells[axis] = lattice[axis];
      layer *= lattice[axis];
      ++axis;
    }
    part.Cells[axis] = std::min(lattice[axis] - part.Low[axis], count / layer);
    first += part.Count();
    count -= part.Count();
    parts.push_back(part);
  }
  return parts;
}

// Parts of a lattice, and where results for their cells are stored. The index of a cell is its
// number, axis 0 fastest, in a part that contains all of them, minus `First`.
template <int Dimension>
struct LatticeParts
{
  // One part, numbered as in another one.
  LatticeParts(const LatticePart<Dimension>& part, const LatticePart<Dimension>& within)
    : Parts{ part }
    , Within(within)
  {
  }
  LatticeParts(std::vector<LatticePart<Dimension>> parts, const LatticePart<Dimension>& within,
    std::int64_t first)
    : Parts(std::move(parts))
    , Within(within)
    , First(first)
  {
  }
  static LatticeParts WholeOf(const GridSize<Dimension>& lattice)
  {
    const auto whole = LatticePart<Dimension>::WholeOf(lattice);
    return { whole, whole };
  }

  std::int64_t IndexOf(const GridSize<Dimension>& cell) const
  {
    return this->Within.NumberOf(cell) - this->First;
  }

  std::vector<LatticePart<Dimension>> Parts;
  LatticePart<Dimension> Within;
  std::int64_t First = 0;
};

} // namespace RectifiedTransport

#endif
