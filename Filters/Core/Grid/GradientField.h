// SPDX-License-Identifier: BSD-3-Clause
// The vector field -grad q of a function q at nodes, by which points move. Points are in cells of
// the nodes.
#ifndef RectifiedTransport_GradientField_h
#define RectifiedTransport_GradientField_h

#include "Core/Grid/NodeGrid.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// One vector a node, coordinates interleaved.
template <int Dimension>
class GradientField
{
public:
  // -grad q in cells of the nodes, -(q_{i+1} - q_{i-1}) / (2 h^2) along each axis, and 0 across the
  // faces of the box, so that none leaves it. Adds a unit of work a node. Throws std::bad_alloc and
  // Cancelled.
  GradientField(const NodeGrid<Dimension>& grid, const double* q, Progress& progress)
    : Cells(grid.Cells)
    , Moves(grid.NumberOfNodes() * Dimension)
  {
    const std::int64_t nodes = grid.Cells[0] + 1;
    const std::int64_t lines = std::max<std::int64_t>(1, 4096 / nodes);
    progress.For(grid.NumberOfNodes(), lines * nodes, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t begin = first; begin < last; begin += nodes)
      {
        this->WriteLine(grid, q, begin);
      }
    });
  }

  const GridSize<Dimension>& Size() const { return this->Cells; }
  // The field at a point, by multilinear interpolation.
  Point<Dimension> At(const double* point) const
  {
    const HatWeights<Dimension> hats(point, this->Cells);
    Point<Dimension> move{};
    for (int corner = 0; corner < HatWeights<Dimension>::Count; ++corner)
    {
      const double* of = this->Moves.data() + hats.Node[corner] * Dimension;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        move[axis] += hats.Weight[corner] * of[axis];
      }
    }
    return move;
  }

private:
  // The vectors of a line of nodes along axis 0 that begins at node `begin`.
  void WriteLine(const NodeGrid<Dimension>& grid, const double* q, std::int64_t begin)
  {
    const std::int64_t nodes = grid.Cells[0] + 1;
    std::int64_t stride = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double scale = 0.5 / (grid.Spacing[axis] * grid.Spacing[axis]);
      const std::int64_t across = begin / stride % (grid.Cells[axis] + 1);
      for (std::int64_t i = 0; i < nodes; ++i)
      {
        const std::int64_t at = axis == 0 ? i : across;
        const std::int64_t node = begin + i;
        this->Moves.data()[node * Dimension + axis] =
          at == 0 || at == grid.Cells[axis] ? 0.0 : scale * (q[node - stride] - q[node + stride]);
      }
      stride *= grid.Cells[axis] + 1;
    }
  }

  GridSize<Dimension> Cells;
  LargeBuffer<double> Moves;
};

} // namespace RectifiedTransport

#endif
