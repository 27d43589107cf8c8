// SPDX-License-Identifier: BSD-3-Clause
// Boxes of whole cells of a density.
#ifndef RectifiedTransport_BoxCells_h
#define RectifiedTransport_BoxCells_h

#include "Core/Flow/FlowEngine.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
double boxVolume(const Point<Dimension>& low, const Point<Dimension>& high)
{
  double volume = 1.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    volume *= high[axis] - low[axis];
  }
  return volume;
}

// function(low, high) of each cell of a box.
template <int Dimension, class Function>
void forCells(const Point<Dimension>& low, const Point<Dimension>& high, const Function& function)
{
  for (Point<Dimension> from = low; from[Dimension - 1] < high[Dimension - 1];)
  {
    Point<Dimension> to = from;
    for (double& coordinate : to)
    {
      coordinate += 1.0;
    }
    function(from, to);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      from[axis] += 1.0;
      if (from[axis] < high[axis] || axis + 1 == Dimension)
      {
        break;
      }
      from[axis] = low[axis];
    }
  }
}

template <int Dimension>
void prepareShares(
  FlowEngine<Dimension>& engine, const Point<Dimension>& low, const Point<Dimension>& high)
{
  const auto integers = [](const Point<Dimension>& point) {
    GridSize<Dimension> found;
    std::transform(point.begin(), point.end(), found.begin(),
      [](double place) { return static_cast<std::int64_t>(place); });
    return found;
  };
  engine.PrepareShares(integers(low), integers(high));
}

} // namespace RectifiedTransport

#endif
