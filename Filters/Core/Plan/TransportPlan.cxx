// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Plan/TransportPlan.h"

#include "Core/Flow/Particles/DisplacementInterpolation.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Messages/PartText.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Seeds a chunk of parallel loops.
constexpr std::int64_t grain = std::int64_t{ 1 } << 13;

// Why an optimal map does not serve whose masses of blocks have this error; empty if it does.
std::string unresolvedText(double massError)
{
  // A relative L2 error of 10 %: nodes that resolve the target have some hundredths.
  constexpr double most = 0.1;
  if (!(massError > most))
  {
    return {};
  }
  return "Method Optimal did not reach the density, which is too thin for its grid: the masses of "
         "blocks of 8 cells a side are off by " +
    percentText(massError) + ", more than " + percentText(most) +
    "; the map is that of Method RectifiedFlow, and TransportCostLowerBound holds (a finer density "
    "helps, for example by Resample To Image)";
}

// Reads an end's values, with its box, for the optimal map.
template <int Dimension>
PlacedDensity<Dimension> read(const PlanEnd<Dimension>& end, const Context& context)
{
  return { end.Read(context), end.Low, end.High };
}

// Ends whose values are read again when they are needed may go meanwhile.
template <int Dimension>
void release(const PlanEnd<Dimension>& end)
{
  if (end.Release)
  {
    end.Release();
  }
}

// Moves a point of the index space of one box to that of another one: their unit boxes correspond.
// The clamp guards the upper face against rounding.
template <int Dimension>
void rescale(const double* point, const GridSize<Dimension>& from, const GridSize<Dimension>& to,
  double* scaled)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const auto size = static_cast<double>(to[axis]);
    const double ratio = size / static_cast<double>(from[axis]);
    scaled[axis] = std::min(size, point[axis] * ratio);
  }
}

// Calls visit(number, place in the positions) for all seeds, in a fixed order. Lattices may leave
// gaps between the positions of their parts.
template <int Dimension, class Visit>
void forPositions(
  const FlowSeeds<Dimension>& seeds, std::int64_t count, Progress& progress, const Visit& visit)
{
  if (!seeds.IsLattice())
  {
    progress.ForEach(count, grain, [&](std::int64_t i) { visit(i, i); });
    return;
  }
  std::int64_t before = 0;
  progress.Expect(count);
  for (const LatticePart<Dimension>& part : seeds.Parts().Parts)
  {
    progress.ForEach(part.Count(), grain,
      [&](std::int64_t i) { visit(before + i, seeds.Parts().IndexOf(part.CellOf(i))); });
    before += part.Count();
  }
}

// The number of seeds of this rank.
template <int Dimension>
std::int64_t countOf(const FlowSeeds<Dimension>& seeds)
{
  std::int64_t count = seeds.Points().size();
  if (seeds.IsLattice())
  {
    for (const LatticePart<Dimension>& part : seeds.Parts().Parts)
    {
      count += part.Count();
    }
  }
  return count;
}

} // namespace

template <int Dimension>
PlanEnd<Dimension>::PlanEnd(const PlacedDensity<Dimension>& density)
  : Size(density.Source.Size)
  , Low(density.Low)
  , High(density.High)
  , Read([source = density.Source](const Context&) { return source; })
{
}

// Lengths in units of about the grid's diagonal keep squared distances in the range of doubles.
template <int Dimension>
PlanEnd<Dimension> PlanEnd<Dimension>::On(const ImageGrid& grid)
{
  const LengthScale scale(grid);
  PlanEnd end;
  end.Size = grid.Size<Dimension>();
  end.High = grid.Lengths<Dimension>();
  for (double& side : end.High)
  {
    side = scale.ToUnits(side);
  }
  return end;
}

// The corners of a grid's box in lengths of another box, by physical coordinates. A corner that is
// a face of the box up to rounding is set exactly there, as the solver asks whether a density fills
// its box.
template <int Dimension>
PlanEnd<Dimension> PlanEnd<Dimension>::In(const ImageGrid& box, const ImageGrid& grid)
{
  constexpr double rounding = 1e-9; // relative to the sides
  const LengthScale scale(box);
  const Point<Dimension> lengths = box.Lengths<Dimension>();
  const GridSize<Dimension> cells = box.Size<Dimension>();
  PlanEnd placed;
  placed.Size = grid.Size<Dimension>();
  Point<Dimension> corner{};
  for (Point<Dimension>* end : { &placed.Low, &placed.High })
  {
    double x[3];
    grid.ToPhysical<Dimension>(corner.data(), x);
    box.ToIndex<Dimension>(x, end->data());
    for (int axis = 0; axis < Dimension; ++axis)
    {
      double part = (*end)[axis] / static_cast<double>(cells[axis]);
      part = std::abs(part) < rounding ? 0.0 : std::abs(part - 1.0) < rounding ? 1.0 : part;
      (*end)[axis] = part * scale.ToUnits(lengths[axis]);
      corner[axis] = static_cast<double>(placed.Size[axis]);
    }
  }
  return placed;
}

template <int Dimension>
TransportPlan<Dimension>::TransportPlan(
  PlanEnd<Dimension> target, const PlanOptions& options, const Context& context, Map map)
  : TransportPlan({ std::nullopt, std::move(target) }, options, std::move(map), context)
{
}

template <int Dimension>
TransportPlan<Dimension>::TransportPlan(PlanEnd<Dimension> source, PlanEnd<Dimension> target,
  const PlanOptions& options, const Context& context, Map map)
  : TransportPlan({ std::move(source), std::move(target) }, options, std::move(map), context)
{
}

// Solves the map that is needed, unless it is given. A map that does not resolve the target is kept
// for its bound alone; flows then move the points.
template <int Dimension>
TransportPlan<Dimension>::TransportPlan(std::array<std::optional<PlanEnd<Dimension>>, 2> ends,
  const PlanOptions& options, Map map, const Context& context)
  : Ends(std::move(ends))
  , Chosen(options)
  , Optimal(std::move(map))
{
  if (!options.NeedsMap())
  {
    return;
  }
  Progress progress(context);
  Stages stages(
    progress, { { "map", this->Optimal ? 0.0 : 9.0 }, { "check", options.IsOptimal ? 1.0 : 0.0 } });
  if (!this->Optimal)
  {
    this->Optimal = Solve(
      this->Ends[0] ? &*this->Ends[0] : nullptr, *this->Ends[1], options.Optimal, stages["map"]);
  }
  // The bound is certified whether or not the map resolves the target.
  this->Bound = this->Optimal->LowerBound();
  if (options.IsOptimal)
  {
    // The error of masses needs the map's images, so it is only measured if the map is to move
    // points.
    this->Text = unresolvedText(this->Optimal->MassError(stages["check"]));
  }
}

// The values are only needed until the map has its own copy, and are released before the long part.
template <int Dimension>
typename TransportPlan<Dimension>::Map TransportPlan<Dimension>::Solve(
  const PlanEnd<Dimension>* source, const PlanEnd<Dimension>& target,
  const OptimalMapOptions& options, const Context& context)
{
  Progress progress(context);
  Stages stages(
    progress, { { "source", 1 }, { "target", 1 }, { "set-up", 3 }, { "solution", 95 } });
  std::shared_ptr<OptimalMap<Dimension>> map;
  if (source)
  {
    // Both densities are in memory until the map has its own shares of cells.
    const PlacedDensity<Dimension> from = read(*source, stages["source"]);
    const PlacedDensity<Dimension> to = read(target, stages["target"]);
    map = std::make_shared<OptimalMap<Dimension>>(from, to, options, stages["set-up"]);
    release(*source);
  }
  else
  {
    Point<Dimension> sides = target.High;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      sides[axis] -= target.Low[axis];
    }
    const DensitySource<Dimension> to = target.Read(stages["target"]);
    map = std::make_shared<OptimalMap<Dimension>>(to, sides, options, stages["set-up"]);
  }
  release(target);
  map->Solve(stages["solution"]);
  return map;
}

// Two threads may need the same flow: the first one makes it, under the lock.
template <int Dimension>
const RectifiedFlow<Dimension>& TransportPlan<Dimension>::FlowOf(
  std::size_t end, const Context& context) const
{
  const std::lock_guard<std::mutex> lock(this->Making);
  PlanEnd<Dimension>& density = *this->Ends[end];
  if (!density.Flow)
  {
    density.Flow = std::make_shared<const RectifiedFlow<Dimension>>(density.Read(context), context);
    release(density);
  }
  return *density.Flow;
}

// Frees the optimal map first, so that both are never in memory together.
template <int Dimension>
void TransportPlan<Dimension>::MakeFlows(const Context& context)
{
  if (this->IsOptimal())
  {
    return;
  }
  this->Optimal = nullptr;
  Progress progress(context);
  Parts parts(progress, 2);
  // The uniform measure has no flow of its own.
  for (std::size_t end = this->Ends[0] ? 0 : 1; end < 2; ++end)
  {
    this->FlowOf(end, parts[static_cast<std::int64_t>(end)]);
  }
}

// Without a source density one flow moves the points; between two densities there are two on the
// way.
template <int Dimension>
std::vector<FlowReport> TransportPlan<Dimension>::Move(FlowDirection direction,
  const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions, const Context& context) const
{
  // Reports are those of the flows on the way, in its order.
  const bool isForward = direction == FlowDirection::Forward;
  if (this->IsOptimal())
  {
    return { isForward ? this->Optimal->Forward(seeds, positions, context)
                       : this->Optimal->Backward(seeds, positions, context) };
  }
  if (this->Ends[0])
  {
    return this->MoveByFlows(isForward ? 0 : 1, seeds, positions, context);
  }
  // From the uniform measure the target's flow is the map itself.
  const RectifiedFlow<Dimension>& flow = this->FlowOf(1, context);
  return { isForward ? flow.Forward(seeds, positions, this->Chosen.Flow, context)
                     : flow.Backward(seeds, positions, this->Chosen.Flow, context) };
}

// Composition through the uniform measure (Section 3.4): back to it by the first flow, to the other
// unit box, and on by the second.
template <int Dimension>
std::vector<FlowReport> TransportPlan<Dimension>::MoveByFlows(std::size_t from,
  const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions, const Context& context) const
{
  Progress progress(context);
  Stages stages(progress, { { "back", 50 }, { "starts", 1 }, { "forth", 48 }, { "images", 1 } });
  const RectifiedFlow<Dimension>& first = this->FlowOf(from, stages["back"]);
  const RectifiedFlow<Dimension>& second = this->FlowOf(1 - from, stages["back"]);
  const FlowOptions& options = this->Chosen.Flow;
  // The first flow's images of the seeds are points of the uniform measure on its box.
  const FlowReport back = first.Backward(seeds, positions, options, stages["back"]);
  // Starts of the second flow, a point for each seed of this rank.
  const std::int64_t count = countOf(seeds);
  // Positions of a lattice may have gaps, and points of an array have none.
  LargeBuffer<double> between(seeds.IsLattice() ? count * Dimension : 0);
  const PointSpan<Dimension> starts =
    seeds.IsLattice() ? PointSpan<Dimension>(between.data(), count) : positions;
  forPositions(seeds, count, stages["starts"], [&](std::int64_t i, std::int64_t place) {
    rescale<Dimension>(positions[place], first.Size(), second.Size(), starts[i]);
  });
  const FlowReport forth =
    second.Forward(ConstPointSpan<Dimension>(starts), starts, options, stages["forth"]);
  if (seeds.IsLattice())
  {
    forPositions(seeds, count, stages["images"], [&](std::int64_t i, std::int64_t place) {
      std::copy_n(starts[i], Dimension, positions[place]);
    });
  }
  return { back, forth };
}

// The last report is that of the flow that ends at the target.
template <int Dimension>
FlowReport TransportPlan<Dimension>::Forward(
  const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions, const Context& context) const
{
  return this->Move(FlowDirection::Forward, seeds, positions, context).back();
}

template <int Dimension>
FlowReport TransportPlan<Dimension>::Backward(
  const FlowSeeds<Dimension>& points, PointSpan<Dimension> positions, const Context& context) const
{
  return this->Move(FlowDirection::Backward, points, positions, context).back();
}

// A point of the source's index space in that of the target: both boxes lie in the same physical
// space.
template <int Dimension>
Point<Dimension> TransportPlan<Dimension>::ToTarget(const Point<Dimension>& point) const
{
  const PlanEnd<Dimension>& from = *this->Ends[0];
  const PlanEnd<Dimension>& to = *this->Ends[1];
  Point<Dimension> there;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // Index space to fractions of the source's box, to lengths, and back into the target's index
    // space.
    const double part = point[axis] / static_cast<double>(from.Size[axis]);
    const double length = from.Low[axis] + part * (from.High[axis] - from.Low[axis]);
    there[axis] =
      (length - to.Low[axis]) / (to.High[axis] - to.Low[axis]) * static_cast<double>(to.Size[axis]);
  }
  return there;
}

// From the uniform measure, intermediate positions are the flow's own; between two densities they
// are (1 - t) x + t T(x), as by displacement interpolation.
template <int Dimension>
FlowReport TransportPlan<Dimension>::ForwardAt(const FlowSeeds<Dimension>& seeds,
  const std::vector<double>& times, PointSpan<Dimension> positions, const Context& context) const
{
  if (this->IsOptimal())
  {
    return this->Optimal->ForwardAt(seeds, times, positions, context);
  }
  if (!this->Ends[0])
  {
    return this->FlowOf(1, context).ForwardAt(seeds, times, positions, this->Chosen.Flow, context);
  }
  return interpolateDisplacement<Dimension>(*this, seeds, times, positions, context,
    [this](const Point<Dimension>& point) { return this->ToTarget(point); });
}

template struct PlanEnd<1>;
template struct PlanEnd<2>;
template struct PlanEnd<3>;
RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(TransportPlan);

} // namespace RectifiedTransport
