// SPDX-License-Identifier: BSD-3-Clause
// The masses of nodes' hat functions in points, as sums of integers.
#ifndef RectifiedTransport_NodeSums_h
#define RectifiedTransport_NodeSums_h

#include "Core/Grid/NodeGrid.h"
#include "Core/OptimalMap/Nodes/IntegerSums.h"
#include "Core/OptimalMap/Nodes/NodeMap.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
class NodeSums
{
public:
  // For about so many points, whose masses sum to at most `most`.
  NodeSums(
    const NodeGrid<Dimension>& grid, double most, std::int64_t points, const Progress& progress)
    : Sums(grid.NumberOfNodes(), points, progress)
    , Cells(grid.Cells)
    , Scale(std::ldexp(1.0, 61 - std::ilogb(most)))
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Strides[static_cast<std::size_t>(axis)] = grid.Stride(axis);
    }
  }

  // What one thread adds to, as IntegerSums::Part.
  class Part
  {
  public:
    explicit Part(NodeSums& sums)
      : All(sums)
      , Own(sums.Sums)
    {
    }

    // Shares a mass among the nodes about a point of the box, in cells of the nodes, by their hats.
    void Add(double mass, const double* point)
    {
      const CellPlace<Dimension> at(point, this->All.Cells);
      std::int64_t node = at.Cell[0];
      for (int axis = 1; axis < Dimension; ++axis)
      {
        node += at.Cell[axis] * this->All.Strides[static_cast<std::size_t>(axis)];
      }
      this->template AddTo<Dimension - 1>(
        this->Own.Values() + node, mass * this->All.Scale, at.Place);
    }

  private:
    // Divides a mass along an axis, and then along those before.
    template <int Axis>
    void AddTo(std::int64_t* values, double mass, const Point<Dimension>& place)
    {
      const double high = mass * place[Axis];
      const double low = mass - high;
      if constexpr (Axis == 0)
      {
        values[0] += static_cast<std::int64_t>(low);
        values[1] += static_cast<std::int64_t>(high);
      }
      else
      {
        this->template AddTo<Axis - 1>(values, low, place);
        this->template AddTo<Axis - 1>(values + this->All.Strides[Axis], high, place);
      }
    }

    const NodeSums& All;
    IntegerSums::Part Own;
  };

  // Writes function(node, sum) of the nodes, and sets the sums to 0, as IntegerSums::Finish.
  template <class Function>
  void Write(double* values, Progress& progress, const Function& function)
  {
    const double unit = 1.0 / this->Scale;
    this->Sums.Finish(progress, [&](std::int64_t node, std::int64_t sum) {
      values[node] = function(node, static_cast<double>(sum) * unit);
    });
  }

private:
  IntegerSums Sums;
  GridSize<Dimension> Cells;
  std::array<std::int64_t, Dimension> Strides{};
  double Scale; // a power of two
};

// Adds the masses of the nodes' hats in the image of a density, of which the cells between the
// nodes have the masses `cells`, null if each has 1. Adds a unit of work a cell. Throws
// std::bad_alloc and Cancelled.
template <int Dimension>
void pushForward(const NodeMap<Dimension>& map, const double* cells, const SampleFineness& fineness,
  NodeSums<Dimension>& sums, Progress& progress);

} // namespace RectifiedTransport

#endif
