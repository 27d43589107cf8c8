// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Stages.h"
#include "Core/PowerCells/EqualMassPartition.h"
#include "Core/PowerCells/SeparateSites.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Relaxation/RelaxationDescent.h"
#include "Core/Relaxation/RelaxationEnergy.h"
#include "Core/Relaxation/RelaxedPoints.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace RectifiedTransport
{

namespace
{

// Half the cost of the optimal transport from a density to equal masses at points, as a function of
// their positions. Its gradient is the displacement from the centroids of the cells to the points;
// a whole step is that of de Goes et al. 2012 (Section 4.2).
class TransportEnergy final : public RelaxationEnergy<2>
{
public:
  explicit TransportEnergy(EqualMassPartition& partition)
    : Partition(partition)
  {
  }

  // All spacings are 1, the unit. Returns infinity if the masses cannot be made equal.
  double Evaluate(
    ConstPointSpan<2> points, PointSpan<2> gradient, double* spacings, Progress& progress) override
  {
    // Each evaluation solves the dual problem, beginning with the last weights.
    if (!this->Partition.Solve(points, progress))
    {
      return std::numeric_limits<double>::infinity();
    }
    // With the weights of the optimal partition, the derivative of the cost of point i with respect
    // to its place is 2 mass (x_i - centroid_i): the derivatives of the cells' borders cancel
    // (envelope theorem). The masses are 1 here, so half the cost has the gradient x - centroid,
    // and a unit step along minus the gradient is a step of Lloyd's method.
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

  // Points go to the nearest place where the density has mass, which lowers the cost most, and stay
  // distinct. Points that begin where it has none go the whole way only with a whole step, because
  // the cost may rise over long ways.
  void Aim(ConstPointSpan<2> points, PointSpan<2> steps, std::vector<char>& aimed,
    Progress& progress) const override
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

  void Constrain(ConstPointSpan<2> from, PointSpan<2> points, Progress& progress) const override
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

  // Moves points that the diagram cannot tell apart, within the domain.
  void Separate(PointSpan<2> points, Progress& progress) const
  {
    separateSites(
      points, leastSiteDistance, { { 0.0, 0.0 }, this->Partition.Density().Lengths() }, progress);
  }

private:
  // Visits the points at which the density has mass, or those at which it has none.
  template <class Visit>
  void VisitPoints(
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

  EqualMassPartition& Partition;
};

} // namespace

NoEqualMasses::NoEqualMasses()
  : std::runtime_error("no cells of equal masses were found: the points are too far from "
                       "distributed like the density")
{
}

RelaxationReport relaxByTransport(const DensitySource<2>& density, const Point<2>& spacing,
  PointSpan<2> points, const RelaxationOptions& options, const Context& context)
{
  check(options);
  if (points.size() == 0)
  {
    return { { 0.0 } };
  }
  Progress progress(context);
  Stages stages(progress, { { "points", 5 }, { "energy", 15 }, { "descent", 80 } });
  const auto count = static_cast<double>(points.size());
  const RelaxationFrame<2> frame(density.Size, spacing, points.size());
  RelaxedPoints<2> relaxed(points, frame);
  relaxed.Arrange(stages["points"]);
  // The density is scaled to the mass N, so that each cell has the mass 1.
  EqualMassPartition partition(
    RowMoments(density, frame.CellSides, count, stages["points"]), points.size());
  TransportEnergy energy(partition);
  energy.Separate(relaxed.Get(), stages["points"]);
  // Steps have no bound: the cells of other points change only through the partition, which each
  // evaluation solves again. The function is half the cost, hence the factor 2; dividing by the
  // area of the frame gives the energy a unit that also holds where one side is thin.
  const double area = frame.Sides[0] * frame.Sides[1];
  const DescentSettings settings = { std::numeric_limits<double>::infinity(), 0.0, 2.0 / area };
  RelaxationDescent<2> descent(energy, frame, settings, relaxed.Coordinates(), stages["energy"]);
  if (!descent.HasEnergy())
  {
    throw NoEqualMasses();
  }
  const RelaxationReport report = descent.Run(options, stages["descent"]);
  relaxed.Write(density.Size, points);
  progress.EndSlice(1);
  return report;
}

} // namespace RectifiedTransport
