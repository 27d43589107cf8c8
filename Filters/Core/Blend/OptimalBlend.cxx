// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Blend/OptimalBlend.h"

#include "Core/Blend/BlendSplat.h"
#include "Core/Flow/WeightedMean.h"
#include "Core/Geometry/MeanSquare.h"
#include "Core/Geometry/PhysicalPoints.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t blendGrain = std::int64_t{ 1 } << 12;
constexpr int mostRounds = 20; // fixed-point iterations of a barycenter

// Particles and maps are in the index spaces of the densities, which differ, and in lengths along
// the axes that all of them share.
template <int D>
class OptimalBlender
{
public:
  OptimalBlender(const std::vector<BlendedDensity<D>>& densities,
    const OptimalBlendOptions& options, Progress& progress)
    : Densities(densities)
    , Options(options)
    , Scale(options.Geometry)
    , Work(progress)
    , Count(densities.front().Positions.size())
    , All(static_cast<double>(sumOverRanks(progress.Group(), this->Count)))
  {
    // nullptr as long as the particles keep the positions that were given.
    this->Result.Moved.resize(densities.size());
    this->Result.Slack = LargeBuffer<double>(this->Count);
    std::fill_n(this->Result.Slack.data(), this->Count, 0.0);
  }

  OptimalPositions Run()
  {
    if (this->Options.IsPair)
    {
      this->BlendPair();
    }
    else
    {
      this->BlendAll();
    }
    return std::move(this->Result);
  }

private:
  // Returns the particles' positions in density i: moved by the optimal map, or as given.
  ConstPointSpan<3> PositionsIn(std::size_t i) const
  {
    return this->Result.Moved[i] ? ConstPointSpan<3>(this->Result.Moved[i]->data(), this->Count)
                                 : this->Densities[i].Positions;
  }

  // The maps of a round that is repeated need few iterations; those of the last round get more of
  // them and a refined bound.
  PlanOptions OptionsOf(int leastIterations, bool refines) const
  {
    PlanOptions options;
    options.IsOptimal = this->Options.IsOptimal;
    options.HasBound = true;
    options.Optimal.Tolerance = this->Options.Tolerance;
    options.Optimal.LeastIterations = leastIterations;
    options.Optimal.RefineBound = refines;
    return options;
  }

  // Returns physical positions in the index space of a grid, moved into the domain.
  LargeBuffer<double> IndexOf(const ImageGrid& grid, ConstPointSpan<3> positions)
  {
    LargeBuffer<double> index(this->Count * D);
    double* out = index.data();
    this->Work.Threads().For(this->Count, blendGrain, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        grid.ToIndex<D>(positions[i], out + D * i);
        grid.ClampToDomain<D>(out + D * i);
      }
    });
    this->Work.Check();
    return index;
  }

  // Returns points of an index space as physical positions.
  PointBuffer PhysicalOf(const ImageGrid& grid, ConstPointSpan<D> points, Progress& progress)
  {
    const auto physical = std::make_shared<LargeBuffer<double>>(3 * this->Count);
    writePhysical<D>(grid, points, progress, { physical->data(), this->Count });
    return physical;
  }

  // The slack of a pair (x, y) is |x - y|^2 / 2 - phi(x) - psi(y) >= 0 for the dual potentials: it
  // is 0 where the coupling is optimal.
  void AddSlack(const TransportPlan<D>& plan, double weight, ConstPointSpan<D> points,
    ConstPointSpan<D> images, Progress& progress)
  {
    // One value for each particle, in the squared units of the plan.
    LargeBuffer<double> slack(this->Count);
    plan.Certificate()->Slack(points, images, slack.data(), progress);
    double* sum = this->Result.Slack.data();
    this->Work.Threads().For(this->Count, blendGrain, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        sum[i] += weight * this->Scale.SquareFromUnits(slack.data()[i]);
      }
    });
  }

  // Moves particles from the index space of a source by the map. If the map does not reach the
  // density, particles keep the given positions, and there is a warning.
  void Follow(const TransportPlan<D>& plan, std::size_t target, ConstPointSpan<3> starts,
    const ImageGrid& startGrid, bool areSamples, double weight, Progress& progress)
  {
    const BlendedDensity<D>& density = this->Densities[target];
    const LargeBuffer<double> buffer = this->IndexOf(startGrid, starts);
    const ConstPointSpan<D> points(buffer.data(), this->Count);
    if (!plan.Warning().empty())
    {
      this->Result.Warnings.emplace_back(target, plan.Warning());
    }
    LargeBuffer<double> images;
    if (plan.IsOptimal())
    {
      images = LargeBuffer<double>(this->Count * D);
      // Samples of the source may be corrected so that their images have equal masses; other points
      // may not.
      const FlowSeeds<D> seeds(points);
      plan.Forward(
        areSamples ? seeds.AsSamples() : seeds, { images.data(), this->Count }, progress);
      this->Result.Moved[target] =
        this->PhysicalOf(density.Grid, { images.data(), this->Count }, progress);
    }
    else
    {
      images = this->IndexOf(density.Grid, density.Positions);
    }
    if (areSamples)
    {
      this->AddSlack(plan, weight, points, { images.data(), this->Count }, progress);
      // Bounds, costs and slacks of several densities are combined with the weights.
      this->Result.Bound += weight * this->Scale.CostFromUnits(plan.LowerBound());
      if (!this->Options.IsPair)
      {
        this->Result.Cost += weight *
          meanSquare(this->Scale, starts, this->PositionsIn(target), nullptr, this->All, progress);
      }
    }
  }

  // Two densities: one map from the first to the second.
  void BlendPair()
  {
    const BlendedDensity<D>& source = this->Densities[0];
    Stages stages(this->Work, { { "map", 7 }, { "images", 3 } });
    const TransportPlan<D> plan(source.End, this->Densities[1].End,
      this->OptionsOf(leastIterations(this->Options.IsOptimal), true), stages["map"]);
    this->Follow(plan, 1, source.Positions, source.Grid, true, 1.0, stages["images"]);
  }

  // The weighted mean of the positions in all densities, sum of w_i x_i, is the next support of the
  // barycenter.
  LargeBuffer<double> MeanOf(Progress& progress)
  {
    LargeBuffer<double> mean(3 * this->Count);
    std::vector<WeightedPositions> parts;
    for (std::size_t i = 0; i < this->Densities.size(); ++i)
    {
      parts.push_back({ this->PositionsIn(i), this->Densities[i].Weight });
    }
    writeWeightedMean(parts, { mean.data(), this->Count }, progress);
    return mean;
  }

  // Densities of weight 0 have no influence and get no maps.
  std::vector<std::size_t> Used() const
  {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < this->Densities.size(); ++i)
    {
      if (this->Densities[i].Weight > 0.0)
      {
        used.push_back(i);
      }
    }
    return used;
  }

  // Returns whether the particles have the same places in all these densities, up to rounding. Then
  // the densities are the same, and the barycenter is where the particles are.
  bool AreOne(const std::vector<std::size_t>& used)
  {
    constexpr double rounding = 1e-5; // in cells; the flow amplifies the rounding of the densities
    const double most = rounding * std::pow(this->Options.Geometry.CellMeasure(), 1.0 / D);
    const double* first = this->Densities[used.front()].Positions.data();
    const bool areOne = std::all_of(used.begin() + 1, used.end(), [&](std::size_t i) {
      const double* other = this->Densities[i].Positions.data();
      return other == first ||
        std::equal(first, first + 3 * this->Count, other,
          [=](double a, double b) { return std::abs(a - b) <= most; });
    });
    return onAllRanks(this->Work.Group(), areOne);
  }

  // The fixed-point iteration, then a last round that also measures bound and slack.
  void BlendAll()
  {
    // The densities with a positive weight.
    const std::vector<std::size_t> used = this->Used();
    const bool isOptimal = this->Options.IsOptimal;
    if (this->AreOne(used))
    {
      if (isOptimal)
      {
        this->Result.Functional.push_back(0.0);
      }
      return;
    }
    Stages stages(this->Work, { { "rounds", isOptimal ? 5.0 : 0.0 }, { "last round", 1 } });
    if (isOptimal)
    {
      this->TakeRounds(used, stages["rounds"]);
    }
    // The last round has the final maps; its functional is listed only if it is the lowest.
    const double last = this->TakeRound(used, true, stages["last round"]);
    std::vector<double>& all = this->Result.Functional;
    if (!all.empty() && last < all.back())
    {
      all.push_back(last);
    }
  }

  void TakeRounds(const std::vector<std::size_t>& used, Progress& progress)
  {
    constexpr int usual = 3; // about half of the rounds
    Rounds rounds(progress, usual);
    for (int round = 0; round < mostRounds; ++round)
    {
      // The previous positions, if this round turns out to be worse.
      const auto before = this->Result.Moved;
      const double functional = this->TakeRound(used, false, rounds.Next());
      const std::vector<double>& all = this->Result.Functional;
      // The functional is the sum of w_i W2^2(mean, density i), estimated by the lower bounds. It
      // decreases in exact arithmetic; a round that does not lower it is undone.
      // The first round has nothing to compare with and always counts.
      const double fall = all.empty() ? functional : all.back() - functional;
      if (fall <= 0.0)
      {
        this->Result.Moved = before;
        break;
      }
      this->Result.Functional.push_back(functional);
      if (fall < this->Options.Tolerance * functional)
      {
        break;
      }
    }
  }

  // Makes a map from the density of the mean to each density. Returns the weighted mean of their
  // lower bounds, which estimates the functional.
  double TakeRound(const std::vector<std::size_t>& used, bool isLast, Progress& progress)
  {
    const ImageGrid& geometry = this->Options.Geometry;
    Stages stages(progress, { { "mean", 1 }, { "density", 1 }, { "maps", 98 } });
    const LargeBuffer<double> buffer = this->MeanOf(stages["mean"]);
    const ConstPointSpan<3> mean(buffer.data(), this->Count);
    const GridSize<D> size = geometry.Size<D>();
    LargeBuffer<double> density(geometry.NumberOfCells()); // each rank has the whole
    // The barycenter as a density: the particles at the mean positions, splatted on the common
    // grid.
    splatInCells<D>(mean, nullptr, nullptr, geometry, LatticePart<D>::WholeOf(size), 1.0,
      density.data(), stages["density"]);
    const DensityArray<D, double> values(density.data(), size);
    const auto place = PlanEnd<D>::In(geometry, geometry);
    const PlanEnd<D> source(PlacedDensity<D>{ values, place.Low, place.High });
    const PlanOptions options =
      this->OptionsOf(isLast ? leastIterations(this->Options.IsOptimal) : 2, isLast);
    double functional = 0.0;
    Parts maps(stages["maps"], static_cast<std::int64_t>(used.size()));
    std::int64_t done = 0;
    for (const std::size_t i : used)
    {
      Stages parts(maps[done++], { { "map", 7 }, { "images", 3 } });
      const double weight = this->Densities[i].Weight;
      const TransportPlan<D> plan(source, this->Densities[i].End, options, parts["map"]);
      this->Follow(plan, i, mean, geometry, isLast, weight, parts["images"]);
      functional += weight * this->Scale.CostFromUnits(plan.LowerBound());
    }
    return functional;
  }

  const std::vector<BlendedDensity<D>>& Densities;
  const OptimalBlendOptions& Options;
  const LengthScale Scale;
  Progress& Work;
  const std::int64_t Count;
  const double All; // particles on all ranks
  OptimalPositions Result;
};

} // namespace

template <int D>
OptimalPositions blendOptimally(const std::vector<BlendedDensity<D>>& densities,
  const OptimalBlendOptions& options, const Context& context)
{
  Progress progress(context);
  return OptimalBlender<D>(densities, options, progress).Run();
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(blendOptimally);

} // namespace RectifiedTransport
