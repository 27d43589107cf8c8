// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Progress.h"
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
  progress.BeginStage(0.05);
  const auto count = static_cast<double>(points.size());
  const RelaxationFrame<2> frame(density.Size, spacing, points.size());
  RelaxedPoints<2> relaxed(points, frame);
  relaxed.Arrange(progress);
  EqualMassPartition partition(
    RowMoments(density, frame.CellSides, count, progress), points.size());
  TransportEnergy energy(partition);
  energy.Separate(relaxed.Get(), progress);
  // Steps may be as long as they come: the cells of other points do not change by themselves. The
  // function is half the cost, and the frame's area is no unit where one side is thin.
  const double area = frame.Sides[0] * frame.Sides[1];
  const DescentSettings settings = { std::numeric_limits<double>::infinity(), 0.0, 2.0 / area };
  progress.BeginStage(0.2);
  RelaxationDescent<2> descent(energy, frame, settings, relaxed.Coordinates(), progress);
  if (!descent.HasEnergy())
  {
    throw NoEqualMasses();
  }
  const RelaxationReport report = descent.Run(options);
  relaxed.Write(density.Size, points);
  progress.BeginStage(1.0);
  progress.EndSlice(1);
  return report;
}

} // namespace RectifiedTransport
