// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/TransportEnergy.h"

#include "Core/Parallel/Progress.h"

#include <limits>

namespace RectifiedTransport
{

double TransportEnergy::Evaluate(
  ConstPointSpan<2> points, PointSpan<2> gradient, double* spacings, Progress& progress)
{
  if (!this->Partition.Solve(points, progress))
  {
    return std::numeric_limits<double>::infinity();
  }
  double cost = 0.0;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Point<2> centroid = this->Partition.Centroid(i);
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      gradient[i][axis] = points[i][axis] - centroid[axis];
    }
    spacings[i] = 1.0;
    cost += this->Partition.Cost(i);
  }
  return 0.5 * cost;
}

void TransportEnergy::Constrain(PointSpan<2> points, Progress& progress) const
{
  if (!this->Partition.Density().HasEmptyCells())
  {
    return;
  }
  // What is left of the way to the nearest mass: distinct points stay distinct.
  constexpr double rest = 1e-7;
  constexpr std::int64_t grain = 256;
  progress.For(
    points.size(), grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        double* x = points[i];
        const Point<2> nearest = this->Partition.Density().NearestMass({ x[0], x[1] });
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
          x[axis] = nearest[axis] + rest * (x[axis] - nearest[axis]);
        }
      }
    },
    grain * 16);
}

} // namespace RectifiedTransport
