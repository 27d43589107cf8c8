// SPDX-License-Identifier: BSD-3-Clause
// The end of a coupling of cells: what some got beyond their shares goes on to others.
#ifndef RectifiedTransport_PassRest_h
#define RectifiedTransport_PassRest_h

#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/Nodes/IntegerSums.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// What the cells of the target got from the source, as in IntegerSums.h.
template <int Dimension>
struct CellShares
{
  static constexpr int MassAlone = 1;
  // The mass, its first moments, with ways from the source in parts of the whole grid, and its cost
  // from there to the cell, in squared diagonals.
  static constexpr int WithCosts = Dimension + 2;

  const std::int64_t* Got(std::int64_t cell) const { return this->Sums.data() + cell * this->Each; }
  // What a cell got more than its share.
  std::int64_t RestOf(std::int64_t cell, const CellDensity<Dimension>& target) const
  {
    return this->Got(cell)[0] - toInteger(target.Share(cell) * integerUnit);
  }
  GridSize<Dimension> PlaceOf(std::int64_t cell) const
  {
    GridSize<Dimension> place;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      place[axis] = cell % this->Size[axis];
      cell /= this->Size[axis];
    }
    return place;
  }

  GridSize<Dimension> Size;
  Point<Dimension> Sides{};     // of a cell
  double SquaredDiagonal = 0.0; // of the box
  LargeBuffer<std::int64_t> Sums;
  int Each = 0; // sums a cell
};

// Passes it to the nearest cells that got too little, then along a space-filling curve. Shares are
// WithCosts. Returns the cost of the coupling, in which what rounding left counts as if it had to
// cross the whole box. Throws std::bad_alloc and Cancelled.
template <int Dimension>
double passRest(
  const CellShares<Dimension>& shares, const CellDensity<Dimension>& target, Progress& progress);

} // namespace RectifiedTransport

#endif
