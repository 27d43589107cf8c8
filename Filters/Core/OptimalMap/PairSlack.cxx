// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/PairSlack.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

// The constraint of the dual is phi(x) + psi(y) <= |x - y|^2 / 2, with equality on the support of
// an optimal plan (complementary slackness).
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
        // The convex u = |x|^2 / 2 - phi is what is interpolated, so that the slack is never
        // negative. The interpolant of |x|^2 / 2 exceeds it by h^2 r (1 - r) / 2 along each axis.
        const double h = grid.Spacing[axis];
        const double part = place[axis] - std::floor(place[axis]);
        sum += 0.5 * h * h * part * (1.0 - part);
      }
      sum -= HatWeights<Dimension>(place.data(), grid.Cells)
               .Interpolate(solver.Side(side).Potential.data());
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double way = grid.Spacing[axis] * (places[1][axis] - places[0][axis]);
      sum += 0.5 * way * way;
    }
    // Rounding alone could make it negative.
    slack[i] = std::max(0.0, sum);
  });
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(findSlack);

} // namespace RectifiedTransport
