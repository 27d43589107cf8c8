// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Stages.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"
#include "Core/Relaxation/RelaxationDescent.h"
#include "Core/Relaxation/RelaxedPoints.h"
#include "Core/Relaxation/TransportEnergy.h"

#include <limits>
#include <stdexcept>

namespace RectifiedTransport
{

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
