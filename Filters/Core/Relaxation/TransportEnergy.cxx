// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/TransportEnergy.h"

#include "Core/Parallel/Progress.h"
#include "Core/PowerCells/SeparateSites.h"

#include <algorithm>
#include <limits>

namespace RectifiedTransport
{

double TransportEnergy::Evaluate(
  ConstPointSpan<2> points, PointSpan<2> gradient, double* spacings, Progress& progress)
{
  // Each evaluation solves the dual problem, beginning with the last weights.
  if (!this->Partition.Solve(points, progress))
  {
    return std::numeric_limits<double>::infinity();
  }
  // With the weights of the optimal partition, the derivative of the cost of point i with respect
  // to its place is 2 mass (x_i - centroid_i): the derivatives of the cells' borders cancel
  // (envelope theorem). The masses are 1 here, so half the cost has the gradient x - centroid, and
  // a unit step along minus the gradient is a step of Lloyd's method.
  double cost = 0.0;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Point<2>& centroid = this->Partition.Centroid(i);
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      gradient[i][axis] = points[i][axis] - centroid[axis];
    }
    spacings[i] = 1.0;
    cost += this->Partition.Cost(i);
  }
  return 0.5 * cost;
}

template <class Visit>
void TransportEnergy::VisitPoints(
  ConstPointSpan<2> points, bool haveMass, Progress& progress, const Visit& visit) const
{
  constexpr std::int64_t grain = 256;
  progress.ForEach(points.size(), grain, [&](std::int64_t i) {
    if (this->Partition.Density().HasMass({ points[i][0], points[i][1] }) == haveMass)
    {
      visit(i);
    }
  });
}

void TransportEnergy::Aim(
  ConstPointSpan<2> points, PointSpan<2> steps, std::vector<char>& aimed, Progress& progress) const
{
  const RowMoments& density = this->Partition.Density();
  if (!density.HasEmptyCells())
  {
    return;
  }
  const Point<2> lengths = density.Lengths();
  aimed.assign(static_cast<std::size_t>(points.size()), 0);
  // A point without mass aims at the place with mass that is nearest to the end of its step.
  this->VisitPoints(points, false, progress, [&](std::int64_t i) {
    Point<2> end;
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      end[axis] = std::clamp(points[i][axis] + steps[i][axis], 0.0, lengths[axis]);
    }
    end = density.NearestMass(end);
    aimed[static_cast<std::size_t>(i)] = 1;
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      steps[i][axis] = end[axis] - points[i][axis];
    }
  });
}

void TransportEnergy::Constrain(
  ConstPointSpan<2> from, PointSpan<2> points, Progress& progress) const
{
  const RowMoments& density = this->Partition.Density();
  if (!density.HasEmptyCells())
  {
    return;
  }
  // A point with mass that would step out of it is projected to the nearest mass. Projections of
  // several points may coincide, so they are separated.
  this->VisitPoints(from, true, progress, [&](std::int64_t i) {
    const Point<2> nearest = density.NearestMass({ points[i][0], points[i][1] });
    std::copy(nearest.begin(), nearest.end(), points[i]);
  });
  this->Separate(points, progress);
}

void TransportEnergy::Separate(PointSpan<2> points, Progress& progress) const
{
  separateSites(
    points, leastSiteDistance, { { 0.0, 0.0 }, this->Partition.Density().Lengths() }, progress);
}

} // namespace RectifiedTransport
