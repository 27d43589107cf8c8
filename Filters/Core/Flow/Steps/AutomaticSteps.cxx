// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Steps/AutomaticSteps.h"

#include "Core/Flow/Steps/ProbeBlocks.h"
#include "Core/Geometry/ImageMeasure.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/RankShare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// What an error falls by with x times the steps: x^(7/4), by square roots alone, which have the
// same bits everywhere. Measured orders are 1.5 to 2.1.
double fall(double x, Integrator integrator)
{
  return integrator == Integrator::Euler ? x : x * std::sqrt(x) * std::sqrt(std::sqrt(x));
}

// The fewest steps, a multiple of 8, with which an error at `steps` falls by a factor.
int stepsFor(double factor, int steps, Integrator integrator)
{
  constexpr int unit = 8;
  int found = steps;
  while (found < FlowOptions::MostSteps &&
    !(fall(static_cast<double>(found) / steps, integrator) >= factor))
  {
    found += unit;
  }
  return std::min(found, FlowOptions::MostSteps);
}

template <int Dimension>
class StepChooser
{
public:
  StepChooser(FlowEngine<Dimension>& engine, const FlowOptions& options, FlowDirection direction,
    const Context& context)
    : Engine(engine)
    , Options(options)
    , IsBackward(direction == FlowDirection::Backward)
    , Work(context)
    , Probes(engine, direction, this->Work)
  {
    this->Options.Maps = FlowMaps::Off;
    if (this->IsBackward)
    {
      this->ProbeMass();
    }
    for (const ProbeBlock<Dimension>& block : this->Probes.Blocks())
    {
      for (int corner = 0; corner < Corners; ++corner)
      {
        Point<Dimension>& start = this->Starts.emplace_back();
        for (int axis = 0; axis < Dimension; ++axis)
        {
          start[axis] = (corner >> axis & 1) != 0 ? block.High[axis] : block.Low[axis];
        }
      }
    }
  }

  StepChoice Choose()
  {
    constexpr int last = 1024; // steps that are compared with twice as many
    StepChoice choice;
    // Forward the flow expands where it is fast, and no step is too long for that.
    if (this->Probes.Blocks().empty() || (!this->IsBackward && this->Probes.HaveLittleContrast()))
    {
      return choice;
    }
    Images coarse = this->Move(FlowOptions::FewestSteps);
    for (int steps = FlowOptions::FewestSteps;; steps *= 2)
    {
      const Images fine = this->Move(2 * steps);
      const double error = this->ErrorOf(coarse, fine);
      if (std::isnan(error))
      {
        return {};
      }
      const Integrator integrator = this->Options.Integrator;
      choice.NumberOfSteps = stepsFor(error / this->Options.AreaTolerance, steps, integrator);
      choice.AreaError =
        error / fall(static_cast<double>(choice.NumberOfSteps) / steps, integrator);
      if (choice.NumberOfSteps <= 2 * steps || steps == last)
      {
        return this->OrAdaptive(choice);
      }
      coarse = fine;
    }
  }

private:
  // Where few blocks count, mass is in a small part of the domain: the forward flow leads to it.
  void ProbeMass()
  {
    const std::int64_t wanted = this->Probes.WantedBlocks();
    if (2 * static_cast<std::int64_t>(this->Probes.Blocks().size()) >= wanted)
    {
      return;
    }
    Images places;
    for (std::int64_t number = 1; number <= 2 * wanted; ++number)
    {
      places.push_back(evenPlace<Dimension>(number));
      for (int axis = 0; axis < Dimension; ++axis)
      {
        places.back()[axis] *= static_cast<double>(this->Probes.Grid()[axis]);
      }
    }
    FlowOptions options = this->Options;
    options.NumberOfSteps = FlowOptions::FewestSteps;
    this->Move(AdvectionKind::Forward, options, places);
    this->Probes.AddAbout(places, this->Work);
  }

  static constexpr int Corners = 1 << Dimension;
  using Images = std::vector<Point<Dimension>>; // of the corners of all blocks

  Images Move(int steps)
  {
    FlowOptions options = this->Options;
    options.NumberOfSteps = steps;
    return this->Move(options);
  }

  Images Move(const FlowOptions& options)
  {
    Images corners = this->Starts;
    this->Move(
      this->IsBackward ? AdvectionKind::Backward : AdvectionKind::Forward, options, corners);
    return corners;
  }

  // Each rank moves a part. Collective.
  void Move(AdvectionKind kind, const FlowOptions& options, Images& points)
  {
    const auto count = static_cast<std::int64_t>(points.size());
    const Ranks& ranks = this->Work.Group();
    const RankShare share(count, ranks);
    const PointSpan<Dimension> own = PointSpan<Dimension>(points).Part(share.First, share.Count);
    this->Work.BeginStage(0.5 * (1.0 + this->Work.StageEnd())); // how many follow is not known
    const FlowReport report =
      this->Engine.Advect(kind, ConstPointSpan<Dimension>(own), own, options, this->Work.Stage());
    this->Velocities = static_cast<double>(sumOverRanks(ranks, report.Evaluations));
    gatherParts(ranks, shareStarts(count, Dimension, ranks), points.front().data());
  }

  // The estimated error of 99.9 % of all blocks: the largest that is found, times a factor which
  // was measured over many densities. NaN if no block counts.
  double ErrorOf(const Images& coarse, const Images& fine) const
  {
    const std::vector<ProbeBlock<Dimension>>& blocks = this->Probes.Blocks();
    double error = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
      const Point<Dimension>* before = &coarse[i * Corners];
      const Point<Dimension>* after = &fine[i * Corners];
      if (this->IsBackward)
      {
        const double change = imageMeasure<Dimension>(after) - imageMeasure<Dimension>(before);
        error = std::fmax(error, std::abs(change) / blocks[i].Mass);
      }
      else if (this->Probes.IsDense(before) && this->Probes.IsDense(after))
      {
        const double change = this->MassBetween(before, after);
        error = std::fmax(error, std::abs(change) / this->Probes.Volume());
      }
    }
    return (this->IsBackward ? 2.0 : 1.75) * error;
  }

  // The mass that the sides of a block's image sweep over, outwards, on a straight way from one
  // place to another, in cells of the mean density.
  double MassBetween(const Point<Dimension>* before, const Point<Dimension>* after) const
  {
    constexpr int half = Corners / 2; // of the corners of a side
    double mass = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      for (int end = 0; end < 2; ++end)
      {
        // Its axes are the side's and the way, which has the place of `axis` after an even number
        // of exchanges.
        std::array<Point<Dimension>, Corners> swept;
        int count = 0;
        for (int corner = 0; corner < Corners; ++corner)
        {
          if ((corner >> axis & 1) == end)
          {
            swept[static_cast<std::size_t>(count)] = before[corner];
            swept[static_cast<std::size_t>(count + half)] = after[corner];
            ++count;
          }
        }
        const bool isTurned = (Dimension - 1 - axis) % 2 != (end == 0 ? 1 : 0);
        const double measure = imageMeasure<Dimension>(swept.data());
        mass += (isTurned ? -measure : measure) * this->MeanAbout(swept);
      }
    }
    return mass;
  }

  // The mean density in the box about points, at least a cell wide.
  double MeanAbout(const std::array<Point<Dimension>, Corners>& points) const
  {
    const GridSize<Dimension>& size = this->Probes.Grid();
    Point<Dimension> low = points[0];
    Point<Dimension> high = points[0];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      for (const Point<Dimension>& point : points)
      {
        low[axis] = std::min(low[axis], point[axis]);
        high[axis] = std::max(high[axis], point[axis]);
      }
      const double missing = std::max(0.0, 1.0 - (high[axis] - low[axis]));
      low[axis] = std::max(0.0, low[axis] - 0.5 * missing);
      high[axis] = std::min(static_cast<double>(size[axis]), high[axis] + 0.5 * missing);
    }
    return this->Probes.MeanIn(low, high);
  }

  // Where many steps are needed, those of each particle's own may take less time.
  StepChoice OrAdaptive(const StepChoice& choice)
  {
    constexpr int many = 512;
    constexpr double partOfTolerance = 1.0 / 200.0; // in cells, of AreaTolerance
    constexpr double finer = 0.25;
    constexpr double cost = 2.4; // of a velocity, in those of Multistep
    if (choice.NumberOfSteps <= many || this->Options.Integrator != Integrator::Multistep ||
      !this->Engine.HasWholeTables())
    {
      return choice;
    }
    FlowOptions options = this->Options;
    options.Integrator = Integrator::Adaptive;
    options.Tolerance = partOfTolerance * this->Options.AreaTolerance;
    Images coarse = this->Move(options);
    const double steps = choice.NumberOfSteps * static_cast<double>(coarse.size());
    while (cost * this->Velocities < steps)
    {
      StepChoice found = choice;
      found.Tolerance = options.Tolerance;
      options.Tolerance *= finer;
      const Images fine = this->Move(options);
      found.AreaError = this->ErrorOf(coarse, fine);
      if (found.AreaError <= this->Options.AreaTolerance)
      {
        return found;
      }
      coarse = fine;
    }
    return choice;
  }

  FlowEngine<Dimension>& Engine;
  FlowOptions Options;
  const bool IsBackward;
  Progress Work;
  ProbeBlocks<Dimension> Probes;
  Images Starts;
  double Velocities = 0.0; // of all corners, of the last move
};

} // namespace

template <int Dimension>
StepChoice chooseSteps(FlowEngine<Dimension>& engine, const FlowOptions& options,
  FlowDirection direction, const Context& context)
{
  // Adaptive takes no fixed steps, and more of them do not make Nearest more exact.
  if (options.Integrator == Integrator::Adaptive || options.Lookup == TableLookup::Nearest)
  {
    return {};
  }
  return StepChooser<Dimension>(engine, options, direction, context).Choose();
}

template StepChoice chooseSteps<1>(
  FlowEngine<1>&, const FlowOptions&, FlowDirection, const Context&);
template StepChoice chooseSteps<2>(
  FlowEngine<2>&, const FlowOptions&, FlowDirection, const Context&);
template StepChoice chooseSteps<3>(
  FlowEngine<3>&, const FlowOptions&, FlowDirection, const Context&);

} // namespace RectifiedTransport
