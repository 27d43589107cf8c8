// SPDX-License-Identifier: BSD-3-Clause
// Rows of nodes along axis 0, the part of a cell that a node stands for, sums over nodes.
#ifndef RectifiedTransport_NodeRows_h
#define RectifiedTransport_NodeRows_h

#include "Core/Grid/NodeGrid.h"
#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// The nodes of the rows that make a chunk of work.
template <int Dimension>
std::int64_t chunkOfRows(const NodeGrid<Dimension>& grid)
{
  const std::int64_t nodes = grid.Cells[0] + 1;
  return std::max<std::int64_t>(1, 8192 / nodes) * nodes;
}

// The share of a cell that a node stands for along an axis: half of one at both ends.
inline double shareOf(std::int64_t node, std::int64_t cells)
{
  return node == 0 || node == cells ? 0.5 : 1.0;
}

// The share of a cell that an inner node of a row stands for, the product over the axes across it.
template <int Dimension>
double shareOfRow(const NodeGrid<Dimension>& grid, std::int64_t row)
{
  double share = 1.0;
  for (int axis = 1; axis < Dimension; ++axis)
  {
    const std::int64_t nodes = grid.Cells[axis] + 1;
    share *= shareOf(row % nodes, nodes - 1);
    row /= nodes;
  }
  return share;
}

// The sum of term(node), with the same bits on any number of threads. Adds a unit of work a node.
template <int Dimension, class Term>
double sumOverNodes(const NodeGrid<Dimension>& grid, Progress& progress, const Term& term)
{
  return sumTerms(progress, grid.NumberOfNodes(), chunkOfRows(grid), term);
}

} // namespace RectifiedTransport

#endif
