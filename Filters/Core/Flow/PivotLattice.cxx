// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/PivotLattice.h"

#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/FlowMapShape.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/LowDiscrepancy.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// base^Dimension in integers, exact as long as it is below 2^63.
template <int Dimension>
std::int64_t power(std::int64_t base)
{
  std::int64_t product = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    product *= base;
  }
  return product;
}

// The largest number whose power is at most `value`.
template <int Dimension>
std::int64_t integerRoot(std::int64_t value)
{
  // The floating-point root may be off by one, so integers correct it.
  auto guess = static_cast<std::int64_t>(root<Dimension>(static_cast<double>(value)));
  while (power<Dimension>(guess + 1) <= value)
  {
    ++guess;
  }
  while (power<Dimension>(guess) > value)
  {
    --guess;
  }
  return guess;
}

// Point i of `count` consecutive ones of the recurrence, shifted so that points i and count - 1 - i
// are mirror images about the centre.
template <int Dimension>
Point<Dimension> placeInCell(std::int64_t i, std::int64_t count)
{
  constexpr std::uint64_t half = std::uint64_t{ 1 } << 63;
  Point<Dimension> place;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // Additions of steps wrap modulo 2^64, which is modulo 1 of the unit interval.
    const auto halfSteps = static_cast<std::uint64_t>(2 * i - (count - 1));
    // x_i = 1/2 + (i - (count - 1) / 2) a mod 1, with the recurrence's step a along this axis.
    place[axis] = unitReal(half + halfSteps * (lowDiscrepancyStep<Dimension>(axis) / 2));
  }
  return place;
}

} // namespace

template <int Dimension>
PivotLattice<Dimension> pivotLattice(const GridSize<Dimension>& grid, std::int64_t perCell)
{
  PivotLattice<Dimension> samples{ grid, {} };
  // k^Dimension particles a cell are a lattice of k times as many cells; other numbers take one
  // lattice of the grid for each place in a cell.
  const std::int64_t side = integerRoot<Dimension>(perCell);
  if (power<Dimension>(side) == perCell)
  {
    for (std::int64_t& cells : samples.Lattice)
    {
      cells *= side;
    }
    // One particle at the centre of each of the smaller cells.
    samples.Places.push_back(cellCentre<Dimension>());
    return samples;
  }
  for (std::int64_t i = 0; i < perCell; ++i)
  {
    samples.Places.push_back(placeInCell<Dimension>(i, perCell));
  }
  return samples;
}

template <int Dimension>
FlowReport transportPivot(const RectifiedFlow<Dimension>& flow,
  const PivotLattice<Dimension>& pivot, std::int64_t first, PointSpan<Dimension> positions,
  const FlowOptions& options, const Context& context)
{
  const std::int64_t particles = pivot.NumberOfParticles();
  const std::int64_t last = first + positions.size();
  if (first < 0 || last > particles)
  {
    throw std::invalid_argument("there is memory for positions " + std::to_string(first) + " to " +
      std::to_string(last - 1) + ", but the pivot has " + std::to_string(particles) + " particles");
  }
  const auto places = static_cast<std::int64_t>(pivot.Places.size());
  // Particles are numbered place by place.
  const std::int64_t each = places > 0 ? particles / places : 0;
  // All places take the same way, as the particles of one run do.
  check(options);
  Progress progress(context);
  const bool choosesSteps = options.NumberOfSteps == 0;
  Stages stages(progress, { { "steps", choosesSteps ? 1.0 : 0.0 }, { "particles", 9 } });
  FlowReport report;
  FlowOptions same = options;
  if (choosesSteps)
  {
    // The steps and the flow map are those for all particles, whatever part this call asks for.
    same.Particles = static_cast<double>(particles);
    const StepChoice choice = flow.ChooseSteps(same, FlowDirection::Forward, stages["steps"]);
    same = choice.Of(same);
    report.Add(choice);
  }
  report.NumberOfSteps = stepsOf(same);
  same = withFlowMaps<Dimension>(
    same, flow.Size(), FlowDirection::Forward, static_cast<double>(particles));
  Parts parts(stages["particles"], places);
  for (std::int64_t place = 0; place < places; ++place)
  {
    // The particles [low, high) of this place's lattice that are in [first, last). Advections are
    // collective, so ranks without any of them take part.
    const std::int64_t low = std::clamp<std::int64_t>(first - place * each, 0, each);
    const std::int64_t high = std::clamp<std::int64_t>(last - place * each, 0, each);
    if (low == high && !progress.Group().AreSeveral())
    {
      continue;
    }
    const PointSpan<Dimension> part =
      positions.Part(low < high ? place * each + low - first : 0, high - low);
    const auto seeds = FlowSeeds<Dimension>::Lattice(pivot.Lattice,
      { partsOf<Dimension>(pivot.Lattice, low, high - low),
        LatticePart<Dimension>::WholeOf(pivot.Lattice), low },
      pivot.Places[static_cast<std::size_t>(place)]);
    // Reports add up; the step choice is that of all places.
    const FlowReport moved = flow.Forward(seeds, part, same, parts[place]);
    report.Redone += moved.Redone;
    report.MovedToMass += moved.MovedToMass;
    report.Evaluations += moved.Evaluations;
  }
  return report;
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(pivotLattice);

template FlowReport transportPivot<1>(const RectifiedFlow<1>&, const PivotLattice<1>&, std::int64_t,
  PointSpan<1>, const FlowOptions&, const Context&);
template FlowReport transportPivot<2>(const RectifiedFlow<2>&, const PivotLattice<2>&, std::int64_t,
  PointSpan<2>, const FlowOptions&, const Context&);
template FlowReport transportPivot<3>(const RectifiedFlow<3>&, const PivotLattice<3>&, std::int64_t,
  PointSpan<3>, const FlowOptions&, const Context&);

} // namespace RectifiedTransport
