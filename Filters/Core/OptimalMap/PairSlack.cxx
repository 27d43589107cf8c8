// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/PairSlack.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
void findSlack(const PotentialSolver<Dimension>& solver, ConstPointSpan<Dimension> points,
  ConstPointSpan<Dimension> images, double* slack, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  const NodeGrid<Dimension>& grid = solver.Grid();
  progress.ForEach(points.size(), grain, [&](std::int64_t i) {
    double sum = 0.0;
    Point<Dimension> places[2];
    for (int side = 0; side < 2; ++side)
    {
      Point<Dimension>& place = places[side];
      place = solver.Side(side).Placement.ToNodes(side == 0 ? points[i] : images[i]);
      for (int axis = 0; axis < Dimension; ++axis)
      {
        place[axis] = std::clamp(place[axis], 0.0, static_cast<double>(grid.Cells[axis]));
        // What is interpolated is the convex |x|^2 / 2 - potential.
        const double h = grid.Spacing[axis];
        const double part = place[axis] - std::floor(place[axis]);
        sum += 0.5 * h * h * part * (1.0 - part);
      }
      sum -=
        HatsAt<Dimension>(place.data(), grid.Cells).Interpolate(solver.Side(side).Potential.data());
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double way = grid.Spacing[axis] * (places[1][axis] - places[0][axis]);
      sum += 0.5 * way * way;
    }
    slack[i] = std::max(0.0, sum);
  });
}

template decltype(findSlack<1>) findSlack<1>;
template decltype(findSlack<2>) findSlack<2>;
template decltype(findSlack<3>) findSlack<3>;

} // namespace RectifiedTransport
