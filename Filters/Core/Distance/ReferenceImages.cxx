// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distance/ReferenceImages.h"

#include "Core/Parallel/SmallWork.h"
#include "Core/Parallel/Stages.h"
#include "Core/Plan/TransportPlan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace RectifiedTransport
{

namespace
{

// Distances need no certificate, and samples no corrected masses.
OptimalMapOptions optionsOfMaps()
{
  OptimalMapOptions options;
  options.RefineBound = false;
  options.CorrectMasses = false;
  return options;
}

} // namespace

template <int Dimension>
GridSize<Dimension> referenceLattice(const Point<Dimension>& sides)
{
  // The side of a cube for each sample, (product of the sides / samples)^(1 / D); logarithms avoid
  // overflow.
  double logarithm = -std::log(ReferenceSamples);
  for (const double side : sides)
  {
    logarithm += std::log(side);
  }
  const double cell = std::exp(logarithm / Dimension);
  GridSize<Dimension> lattice;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double cells = std::clamp(std::round(sides[axis] / cell), 1.0, ReferenceSamples);
    lattice[axis] = static_cast<std::int64_t>(cells);
  }
  return lattice;
}

template <int Dimension>
ReferenceImages mapReference(
  const DensitySource<Dimension>& density, const Point<Dimension>& sides, const Context& context)
{
  Progress progress(contextForSize(context, numberOfCells<Dimension>(density.Size)));
  Stages stages(progress, { { "map", 75 }, { "images", 25 } });
  PlanOptions options;
  options.IsOptimal = true;
  options.Optimal = optionsOfMaps();
  const TransportPlan<Dimension> plan(
    PlanEnd<Dimension>({ density, {}, sides }), options, stages["map"]);
  const GridSize<Dimension> lattice = referenceLattice<Dimension>(sides);
  const auto samples = static_cast<std::int64_t>(numberOfCells<Dimension>(lattice));
  ReferenceImages images{ LargeBuffer<double>(samples * Dimension) };
  const PointSpan<Dimension> places(images.Coordinates.data(), samples);
  // The optimal map from the uniform measure takes the same samples to each density.
  plan.Forward(FlowSeeds<Dimension>::Lattice(lattice), places, stages["images"]);
  for (std::int64_t i = 0; i < samples; ++i)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // From cells to lengths.
      places[i][axis] *= sides[axis] / static_cast<double>(density.Size[axis]);
    }
  }
  return images;
}

template <int Dimension>
double memoryForReference(const GridSize<Dimension>& cells, const Point<Dimension>& sides)
{
  // The plan, and the images of the samples.
  return TransportPlan<Dimension>::MemoryFor(cells, cells, optionsOfMaps()) +
    sizeof(double) * Dimension * numberOfCells<Dimension>(referenceLattice<Dimension>(sides));
}

template <int Dimension>
double meanSquaredDistance(const ReferenceImages& a, const ReferenceImages& b)
{
  // The linearized distance is the mean of |T_a(x_i) - T_b(x_i)|^2 over the samples x_i of the
  // uniform measure, where T_a and T_b are the optimal maps to the densities.
  //
  // A fixed number of partial sums, which a compiler may keep in registers of any width without
  // changing bits.
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> sums{};
  const double* p = a.Coordinates.data();
  const double* q = b.Coordinates.data();
  const std::int64_t count = a.Coordinates.size();
  const std::int64_t even = count - count % static_cast<std::int64_t>(lanes);
  for (std::int64_t i = 0; i < even; i += lanes)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      const double offset =
        p[i + static_cast<std::int64_t>(lane)] - q[i + static_cast<std::int64_t>(lane)];
      sums[lane] += offset * offset;
    }
  }
  double sum = 0.0;
  for (const double part : sums)
  {
    sum += part;
  }
  for (std::int64_t i = even; i < count; ++i)
  {
    sum += (p[i] - q[i]) * (p[i] - q[i]);
  }
  // The sum has all coordinates, the mean is over samples.
  return sum / static_cast<double>(count / Dimension);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(referenceLattice);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(mapReference);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(memoryForReference);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(meanSquaredDistance);

} // namespace RectifiedTransport
