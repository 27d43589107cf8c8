// SPDX-License-Identifier: BSD-3-Clause
// Where the cells of a density are in the grid of another one.
#ifndef RectifiedTransport_PlacedCells_h
#define RectifiedTransport_PlacedCells_h

#include "Core/Geometry/Boxes/CommonGrid.h"
#include "Core/Tables/CellMeans.h"

namespace RectifiedTransport
{

// Returns the cells of the grid `own` in the index space of `grid`, which covers it along the same
// axes. If both have the same cells up to rounding, the places are exactly the same.
template <int D>
PlacedCells<D> placeCells(const ImageGrid& grid, const ImageGrid& own)
{
  PlacedCells<D> placed{ own.Size<D>(), {}, {} };
  placed.Sides.fill(1.0);
  if (haveSameCells(grid, own))
  {
    return placed;
  }
  double ends[2][D];
  for (int end = 0; end < 2; ++end)
  {
    double index[D];
    for (int axis = 0; axis < D; ++axis)
    {
      index[axis] = end == 0 ? 0.0 : static_cast<double>(placed.Size[axis]);
    }
    double x[3];
    own.ToPhysical<D>(index, x);
    grid.ToIndex<D>(x, ends[end]);
  }
  for (int axis = 0; axis < D; ++axis)
  {
    placed.Low[axis] = ends[0][axis];
    placed.Sides[axis] = (ends[1][axis] - ends[0][axis]) / static_cast<double>(placed.Size[axis]);
  }
  return placed;
}

} // namespace RectifiedTransport

#endif
