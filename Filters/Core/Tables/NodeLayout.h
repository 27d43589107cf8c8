// SPDX-License-Identifier: BSD-3-Clause
// Where the nodes of a table lie in memory, and what views of the tables of a whole density have in
// common.
#ifndef RectifiedTransport_NodeLayout_h
#define RectifiedTransport_NodeLayout_h

#include "Core/Geometry/GridSize.h"
#include "Core/Tables/TableView.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// A box with at most this share of the mass counts as empty: the rounding of the sums.
constexpr double voidShare = 2e-15;

// Sets the strides, in doubles, for this number of nodes an axis. Returns the number of doubles.
template <int Dimension>
std::int64_t layOutNodes(const GridSize<Dimension>& nodes, std::int64_t (&stride)[Dimension]);

// Sets the grid, all of which the nodes cover. Returns the number of words for a bit a cell.
template <int Dimension>
std::int64_t setGrid(TableView<Dimension>& tables, const GridSize<Dimension>& size)
{
  tables.WordsPerRow = (size[0] + 63) / 64;
  std::int64_t words = tables.WordsPerRow;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    tables.Cells[axis] = size[axis];
    tables.Size[axis] = static_cast<double>(size[axis]);
    tables.Low[axis] = 0.0;
    tables.High[axis] = tables.Size[axis];
    words *= axis > 0 ? size[axis] : 1;
  }
  return words;
}

// Sets the centroid M = (sum of f * centre) / (sum of f), from the sums at the last node, the mass
// below which a box counts as empty, and the bits; without empty cells these are left out.
template <int Dimension>
void setTotals(
  TableView<Dimension>& tables, const double* last, std::uint64_t* occupied, std::int64_t words)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    tables.Centroid[axis] = last[1 + axis] / last[0];
  }
  tables.VoidMass = voidShare * last[0];
  const bool isFull = std::all_of(
    occupied, occupied + words, [](std::uint64_t word) { return word == ~std::uint64_t{ 0 }; });
  tables.Occupied = isFull ? nullptr : occupied;
}

} // namespace RectifiedTransport

#endif
