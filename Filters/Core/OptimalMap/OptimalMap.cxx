// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/OptimalMap.h"

#include "Core/Flow/FlowArguments.h"
#include "Core/Flow/Particles/DisplacementInterpolation.h"
#include "Core/OptimalMap/CorrectedMap.h"
#include "Core/OptimalMap/CouplingCost.h"
#include "Core/OptimalMap/FixedCells.h"
#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/Masses/SampleCorrection.h"
#include "Core/OptimalMap/PairSlack.h"
#include "Core/OptimalMap/PotentialSolver.h"
#include "Core/Parallel/SmallWork.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Throws std::invalid_argument unless the options are in their ranges.
void check(const OptimalMapOptions& options)
{
  if (!(options.Tolerance > 0.0 && options.Tolerance < 1.0))
  {
    throw std::invalid_argument("the tolerance of an optimal map is " +
      std::to_string(options.Tolerance) + ", it must be above 0 and below 1");
  }
  if (options.LeastIterations < 0 || options.MostIterations < options.LeastIterations)
  {
    throw std::invalid_argument("an optimal map has from " +
      std::to_string(options.LeastIterations) + " to " + std::to_string(options.MostIterations) +
      " iterations, these numbers must ascend from 0 on");
  }
  if (!(options.MostNodes >= 1.0))
  {
    throw std::invalid_argument(
      "an optimal map has at most " + std::to_string(options.MostNodes) + " nodes, it needs some");
  }
}

// Throws unless all sides of a density's box are positive, with finite squares.
template <int Dimension>
void checkBox(const Point<Dimension>& low, const Point<Dimension>& high)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double side = high[axis] - low[axis];
    if (!(side > 0.0 && std::isfinite(side * side)))
    {
      throw std::invalid_argument("the box of a density has a side of " + std::to_string(side) +
        ", it must be positive, with a finite square");
    }
  }
}

// The point with the same coordinate along each axis.
template <int Dimension>
Point<Dimension> pointOf(double coordinate)
{
  Point<Dimension> point;
  point.fill(coordinate);
  return point;
}

} // namespace

template <int Dimension>
struct OptimalMap<Dimension>::Implementation
{
  // The densities in a box of these sides, of which each fills a part: its low and high corner, in
  // fractions of the sides.
  Implementation(CellDensity<Dimension> source, CellDensity<Dimension> target,
    const Point<Dimension>& sides, const std::array<std::array<Point<Dimension>, 2>, 2>& parts,
    const OptimalMapOptions& options)
    : Densities{ std::move(source), std::move(target) }
    , Sides(sides)
    , Parts(parts)
    , Options(options)
    , Solver(this->Boxed(0), this->Boxed(1), sides, options)
  {
  }

  double Nodes() const { return static_cast<double>(this->Solver.Grid().NumberOfNodes()); }
  // A point takes about as long as ten values of a loop.
  double ValuesOf(PointSpan<Dimension> points) const
  {
    return std::max(this->Nodes(), 10.0 * static_cast<double>(points.size()));
  }
  // A density with the place of its cells, as the solver wants it.
  BoxedDensity<Dimension> Boxed(std::size_t side) const
  {
    return { this->Densities[side], this->Parts[side][0], this->Parts[side][1] };
  }
  // The sides of a density's cells, in the lengths of Sides.
  Point<Dimension> CellSides(std::size_t side) const
  {
    Point<Dimension> sides;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double part = this->Parts[side][1][axis] - this->Parts[side][0][axis];
      sides[axis] =
        part * this->Sides[axis] / static_cast<double>(this->Densities[side].Size()[axis]);
    }
    return sides;
  }
  // Cells can be compared one by one only if both densities have the same cells in the whole box.
  bool HaveSameGrid() const
  {
    return this->Densities[0].Size() == this->Densities[1].Size() &&
      this->Parts[0] == this->Parts[1] && this->Parts[0][0] == pointOf<Dimension>(0.0) &&
      this->Parts[0][1] == pointOf<Dimension>(1.0);
  }

  // The map from a side to the other one, made when it is first wanted. Moving is absent if all
  // mass stands still.
  struct Direction
  {
    std::optional<FixedCells<Dimension>> Fixed;
    std::optional<CorrectedMap<Dimension>> Moving;
  };
  const Direction& MapFrom(int side, Progress& progress)
  {
    // Maps are made once, under the lock; several threads may ask for them.
    const std::lock_guard<std::mutex> lock(this->Mutex);
    Direction& map = this->Maps[static_cast<std::size_t>(side)];
    const auto to = static_cast<std::size_t>(1 - side);
    if (!map.Fixed)
    {
      map.Fixed.emplace(this->Solver, side, this->Densities[to], progress);
    }
    if (!map.Moving && !map.Fixed->AreAll())
    {
      map.Moving.emplace(
        this->Solver, side, this->Densities[to], this->CellSides(to), this->Images(), progress);
    }
    return map;
  }
  // The map from a side to the other one without corrected masses: x - grad potential alone.
  const PointMap<Dimension>& PlainMapFrom(int side, Progress& progress)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::optional<PointMap<Dimension>>& map = this->Plain[static_cast<std::size_t>(side)];
    const auto to = static_cast<std::size_t>(1 - side);
    if (!map)
    {
      map.emplace(
        this->Solver, side, this->Densities[to], this->CellSides(to), this->Images(), progress);
    }
    return *map;
  }
  // Points between nodes are inverted by Newton's method, unless interpolation, which is faster, is
  // asked for.
  PointImages Images() const
  {
    return this->Options.InterpolatePoints ? PointImages::Interpolated : PointImages::Inverted;
  }

  // The map without corrected masses (CorrectMasses off), at all seeds.
  FlowReport MoveUncorrected(int side, const FlowSeeds<Dimension>& seeds,
    PointSpan<Dimension> positions, const Context& context);
  FlowReport Move(int side, const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions,
    const Context& context);
  FlowReport Undo(
    const FlowSeeds<Dimension>& points, PointSpan<Dimension> positions, const Context& context);

  const std::array<CellDensity<Dimension>, 2> Densities;
  const Point<Dimension> Sides;
  const std::array<std::array<Point<Dimension>, 2>, 2> Parts; // low and high, in fractions of Sides
  const OptimalMapOptions Options;
  PotentialSolver<Dimension> Solver;
  double Bound = 0.0;
  OptimalMapReport Info;
  std::mutex Mutex; // guards Maps and Plain
  std::array<Direction, 2> Maps;
  std::array<std::optional<PointMap<Dimension>>, 2> Plain;
};

// From the uniform measure: the source is the constant density on the same cells.
template <int Dimension>
OptimalMap<Dimension>::OptimalMap(const DensitySource<Dimension>& density,
  const Point<Dimension>& sides, const OptimalMapOptions& options, const Context& context)
{
  check(options);
  checkBox<Dimension>(pointOf<Dimension>(0.0), sides);
  check<Dimension>(density.Size, "a density");
  // Small densities take one thread, as waking others takes longer.
  Progress progress(contextForSize(context, numberOfCells<Dimension>(density.Size)));
  const std::array<Point<Dimension>, 2> whole{ pointOf<Dimension>(0.0), pointOf<Dimension>(1.0) };
  this->Self = std::make_unique<Implementation>(CellDensity<Dimension>(density.Size),
    CellDensity<Dimension>(density, progress), sides, std::array{ whole, whole }, options);
}

// Between two densities, each in its own box: the problem's box is the bounding box of both.
template <int Dimension>
OptimalMap<Dimension>::OptimalMap(const PlacedDensity<Dimension>& source,
  const PlacedDensity<Dimension>& target, const OptimalMapOptions& options, const Context& context)
{
  check(options);
  Point<Dimension> low;
  Point<Dimension> sides;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    low[axis] = std::min(source.Low[axis], target.Low[axis]);
    sides[axis] = std::max(source.High[axis], target.High[axis]) - low[axis];
  }
  checkBox<Dimension>(pointOf<Dimension>(0.0), sides);
  std::array<std::array<Point<Dimension>, 2>, 2> parts;
  for (std::size_t i = 0; i < 2; ++i)
  {
    const PlacedDensity<Dimension>& density = i == 0 ? source : target;
    check<Dimension>(density.Source.Size, "a density");
    checkBox<Dimension>(density.Low, density.High);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // Where each density lies in the common box, in fractions of its sides.
      parts[i][0][axis] = (density.Low[axis] - low[axis]) / sides[axis];
      parts[i][1][axis] = (density.High[axis] - low[axis]) / sides[axis];
    }
  }
  Progress progress(contextForSize(context,
    std::max(
      numberOfCells<Dimension>(source.Source.Size), numberOfCells<Dimension>(target.Source.Size))));
  Stages stages(progress, { { "source", 1 }, { "target", 1 } });
  CellDensity<Dimension> first(source.Source, stages["source"]);
  CellDensity<Dimension> second(target.Source, stages["target"]);
  // Densities that agree up to rounding get the same shares in every bit, so that the map is
  // exactly the identity.
  second.TakeIfSame(first, stages["target"]);
  this->Self =
    std::make_unique<Implementation>(std::move(first), std::move(second), sides, parts, options);
}

template <int Dimension>
OptimalMap<Dimension>::~OptimalMap() = default;
template <int Dimension>
OptimalMap<Dimension>::OptimalMap(OptimalMap&&) noexcept = default;
template <int Dimension>
OptimalMap<Dimension>& OptimalMap<Dimension>::operator=(OptimalMap&&) noexcept = default;

// Maximizes the dual (PotentialSolver.cxx). The bound on finer nodes takes two c-transforms, about
// a tenth of the iterations' time.
template <int Dimension>
void OptimalMap<Dimension>::Solve(const Context& context)
{
  Progress progress(context);
  const bool refines = this->Self->Options.RefineBound;
  Stages stages(progress, { { "potentials", 9 }, { "bound", refines ? 1.0 : 0.0 } });
  this->Self->Solver.Solve(stages["potentials"]);
  const double bound =
    refines ? this->Self->Solver.RefinedBound(stages["bound"]) : this->Self->Solver.Bound();
  // A squared distance is at least 0; on nearly uniform densities the error of the nodes may exceed
  // it.
  this->Self->Bound = std::max(0.0, bound);
  this->Self->Info.Iterations = this->Self->Solver.Iterations();
}

template <int Dimension>
const OptimalMapReport& OptimalMap<Dimension>::Report() const
{
  return this->Self->Info;
}

template <int Dimension>
double OptimalMap<Dimension>::MassError(const Context& context) const
{
  if (!this->Self->Options.CorrectMasses)
  {
    return 0.0;
  }
  Progress progress(contextForSize(context, this->Self->Nodes()));
  // The correction measures its error when the map is made; a map that moves nothing has none.
  const auto& map = this->Self->MapFrom(0, progress);
  return map.Moving ? map.Moving->MassError() : 0.0;
}

template <int Dimension>
double OptimalMap<Dimension>::LowerBound() const
{
  return this->Self->Bound;
}

// Any coupling's cost is an upper bound, so the least of both directions is taken. The second one
// is skipped if it cannot pay: what spreading images over cells alone costs is in both.
template <int Dimension>
double OptimalMap<Dimension>::UpperBound(const Context& context, double enough) const
{
  if (!this->Self->HaveSameGrid())
  {
    throw std::invalid_argument("the densities of an upper bound must have the same number of "
                                "cells along each axis, in the same box");
  }
  Progress progress(contextForSize(context, this->Self->Nodes()));
  double least = std::numeric_limits<double>::infinity();
  bool goesOn = true;
  Parts sides(progress, 2);
  for (int side = 0; side < 2 && goesOn; ++side)
  {
    Progress& part = sides[side];
    // The images T(x_i) = x_i - grad phi(x_i) of the nodes.
    auto map = NodeMap<Dimension>::On(this->Self->Solver.Grid());
    writeGradientMap<Dimension>(this->Self->Solver.Side(side).Potential.data(), map, part);
    const auto from = static_cast<std::size_t>(side);
    const CouplingCost cost = couplingCost<Dimension>(
      this->Self->Densities[from], this->Self->Densities[1 - from], std::move(map), part);
    least = std::min(least, cost.All);
    // All - OfSpread is the cost beyond what the cells' extent makes unavoidable.
    goesOn = cost.All - cost.OfSpread > enough;
  }
  return least;
}

template <int Dimension>
void OptimalMap<Dimension>::Slack(ConstPointSpan<Dimension> points,
  ConstPointSpan<Dimension> images, double* slack, const Context& context) const
{
  if (points.size() != images.size())
  {
    throw std::invalid_argument("there are " + std::to_string(points.size()) + " points and " +
      std::to_string(images.size()) + " images, there must be as many of both");
  }
  Progress progress(context);
  findSlack<Dimension>(this->Self->Solver, points, images, slack, progress);
}

template <int Dimension>
const double* OptimalMap<Dimension>::Potential() const
{
  return this->Self->Solver.Side(0).Potential.data();
}

template <int Dimension>
const GridSize<Dimension>& OptimalMap<Dimension>::NodeCells() const
{
  return this->Self->Solver.Grid().Cells;
}

template <int Dimension>
const GridSize<Dimension>& OptimalMap<Dimension>::Size() const
{
  return this->Self->Densities[0].Size();
}

// T at each seed, from one density's index space to the other's, without a correction of masses.
template <int Dimension>
FlowReport OptimalMap<Dimension>::Implementation::MoveUncorrected(int side,
  const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions, const Context& context)
{
  Progress progress(contextForSize(context, this->ValuesOf(positions)));
  Stages stages(progress, { { "map", 2 }, { "points", 8 } });
  const PointMap<Dimension>& map = this->PlainMapFrom(side, stages["map"]);
  ParticleSource<Dimension> source(
    seeds, this->Densities[static_cast<std::size_t>(side)].Size(), positions.size());
  forParticles(source, stages["points"].Expect(source.Count()),
    [&](std::int64_t index, const Point<Dimension>& point) {
      const Point<Dimension> image = map.At(point.data());
      std::copy(image.begin(), image.end(), positions[index]);
    });
  return {};
}

// T at each seed with corrected masses. Samples of the source are then finished together, so that
// each target cell gets its exact count, and what stands still keeps its place.
template <int Dimension>
FlowReport OptimalMap<Dimension>::Implementation::Move(int side, const FlowSeeds<Dimension>& seeds,
  PointSpan<Dimension> positions, const Context& context)
{
  if (!this->Options.CorrectMasses)
  {
    return this->MoveUncorrected(side, seeds, positions, context);
  }
  Progress progress(contextForSize(context, this->ValuesOf(positions)));
  Stages stages(progress, { { "map", 4 }, { "points", 6 } });
  const Direction& map = this->MapFrom(side, stages["map"]);
  const auto from = static_cast<std::size_t>(side);
  ParticleSource<Dimension> source(seeds, this->Densities[from].Size(), positions.size());
  // Only samples have counts that can be exact: other seeds may lie anywhere and in any number.
  const bool areFinished = seeds.AreSamples() && map.Moving;
  // What stands still is finished with the others, and then returns.
  const bool returns = areFinished && !map.Fixed->AreNone();
  LargeBuffer<double> starts(returns ? positions.size() * Dimension : 0);
  Stages steps(stages["points"], { { "images", 4 }, { "finish", areFinished ? 2.0 : 0.0 } });
  forParticles(source, steps["images"].Expect(source.Count()),
    [&](std::int64_t index, const Point<Dimension>& point) {
      Point<Dimension> image = point;
      // Finishing counts all samples, so those that stand still take part with their images under
      // the map.
      if (areFinished || !map.Fixed->Fix(image.data()))
      {
        image = map.Moving->At(point.data());
      }
      double* start = returns ? starts.data() + index * Dimension : nullptr;
      std::copy_n(point.begin(), returns ? Dimension : 0, start);
      std::copy(image.begin(), image.end(), positions[index]);
    });
  if (areFinished)
  {
    correctSamples<Dimension>(
      this->Densities[1 - from], this->CellSides(1 - from), positions, steps["finish"]);
  }
  if (returns)
  {
    map.Fixed->RestoreFixed(starts.data(), positions);
  }
  return {};
}

// The inverse of the corrected map, target to source: the correction is undone first, T_c = C o T,
// so x = T^-1(C^-1(y)).
template <int Dimension>
FlowReport OptimalMap<Dimension>::Implementation::Undo(
  const FlowSeeds<Dimension>& points, PointSpan<Dimension> positions, const Context& context)
{
  Progress progress(contextForSize(context, this->ValuesOf(positions)));
  Stages stages(progress, { { "maps", 4 }, { "points", 6 } });
  const Direction& map = this->MapFrom(0, stages["maps"]);
  const PointMap<Dimension>& back = this->PlainMapFrom(1, stages["maps"]);
  ParticleSource<Dimension> source(points, this->Densities[1].Size(), positions.size());
  forParticles(source, stages["points"].Expect(source.Count()),
    [&](std::int64_t index, const Point<Dimension>& point) {
      Point<Dimension> image = point;
      if (!map.Fixed->FixBackward(image.data()))
      {
        // `back` is the gradient map of the target's potential, the inverse of the plain map.
        image = back.At(map.Moving->Uncorrected(point.data()).data());
      }
      std::copy(image.begin(), image.end(), positions[index]);
    });
  return {};
}

template <int Dimension>
FlowReport OptimalMap<Dimension>::Forward(
  const FlowSeeds<Dimension>& seeds, PointSpan<Dimension> positions, const Context& context) const
{
  return this->Self->Move(0, seeds, positions, context);
}

template <int Dimension>
FlowReport OptimalMap<Dimension>::Backward(
  const FlowSeeds<Dimension>& points, PointSpan<Dimension> positions, const Context& context) const
{
  // With interpolation the inverse of Forward itself is at hand; else the map from the target's
  // side is inverted for each point and has corrected masses of its own.
  return this->Self->Options.InterpolatePoints ? this->Self->Undo(points, positions, context)
                                               : this->Self->Move(1, points, positions, context);
}

// Displacement interpolation: at time t a particle is at (1 - t) x + t T(x). Seeds are converted
// from the source's index space to the target's, in which positions are given.
template <int Dimension>
FlowReport OptimalMap<Dimension>::ForwardAt(const FlowSeeds<Dimension>& seeds,
  const std::vector<double>& times, PointSpan<Dimension> positions, const Context& context) const
{
  // The placements are affine maps between each index space and cells of the nodes.
  const auto& target = this->Self->Solver.Side(1).Placement;
  const auto& from = this->Self->Solver.Side(0).Placement;
  return interpolateDisplacement<Dimension>(
    *this, seeds, times, positions, context, [&](const Point<Dimension>& point) {
      return target.FromNodes(from.ToNodes(point.data()).data());
    });
}

// The target cell that holds each seed's image, numbered with axis 0 fastest.
template <int Dimension>
FlowReport OptimalMap<Dimension>::ForwardToCells(
  const FlowSeeds<Dimension>& seeds, std::int64_t* cells, const Context& context) const
{
  std::int64_t count = seeds.Points().size();
  if (seeds.IsLattice())
  {
    count = static_cast<std::int64_t>(seeds.Count());
  }
  LargeBuffer<double> coordinates(count * Dimension);
  const PointSpan<Dimension> images(coordinates.data(), count);
  Progress progress(context);
  Stages stages(progress, { { "images", 9 }, { "cells", 1 } });
  const FlowReport report = this->Self->Move(0, seeds, images, stages["images"]);
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  stages["cells"].ForEach(
    count, grain, [&](std::int64_t i) { cells[i] = this->Self->Densities[1].CellOf(images[i]); });
  return report;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(OptimalMap);

} // namespace RectifiedTransport
