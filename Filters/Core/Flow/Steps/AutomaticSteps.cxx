// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Steps/AutomaticSteps.h"

#include "Core/Flow/Steps/BlockSurface.h"
#include "Core/Flow/Steps/LittleContrast.h"
#include "Core/Flow/Steps/ProbeBlocks.h"
#include "Core/Flow/Steps/ProbePlan.h"
#include "Core/Flow/Steps/StepBudget.h"
#include "Core/Flow/Steps/SweptMass.h"
#include "Core/Flow/Steps/SymmetricPlace.h"
#include "Core/Geometry/ImageMeasure.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/RankShare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr int unit = 8;            // numbers of steps are multiples of it
constexpr int lastCompared = 1024; // steps, with twice as many

// What an error falls by with x times the steps: x^(7/4), by square roots alone, which have the
// same bits everywhere. Measured orders are 1.5 to 2.1.
double fall(double x, Integrator integrator)
{
  return integrator == Integrator::Euler ? x : x * std::sqrt(x) * std::sqrt(std::sqrt(x));
}

// The fewest steps, a multiple of 8, with which an error at `steps` falls by a factor; more than
// `most` if those do not.
int stepsFor(double factor, int steps, int most, Integrator integrator)
{
  int found = steps;
  while (found <= most && !(fall(static_cast<double>(found) / steps, integrator) >= factor))
  {
    found += unit;
  }
  return found;
}

// The error with a number of steps.
struct Measured
{
  int Steps = 0;
  double Error = 0.0;
};

// Between two measured errors, by a power of the number of steps.
double errorBetween(const Measured& few, const Measured& many, int steps)
{
  constexpr double least = 1e-9;
  const double logOfFew = naturalLogarithm(std::max(few.Error, least));
  const double logOfMany = naturalLogarithm(std::max(many.Error, least));
  const double way = naturalLogarithm(static_cast<double>(steps) / few.Steps) /
    naturalLogarithm(static_cast<double>(many.Steps) / few.Steps);
  return exponential(logOfFew + way * (logOfMany - logOfFew));
}

// Steps as exact as which flow maps need to be. They carry the smooth part of the flow: with as
// many as this the areas of blocks of photographs and of sharp shapes are off by less than the
// tolerance.
template <int Dimension>
int mapStepsFor(const FlowOptions& options)
{
  constexpr int usual = Dimension == 3 ? 48 : 64;
  return stepsFor(FlowOptions::UsualTolerance / options.AreaTolerance, usual,
    FlowOptions::MostSteps, options.Integrator);
}

template <int Dimension>
ProbePlan<Dimension> planOf(
  const FlowEngine<Dimension>& engine, const FlowOptions& options, FlowDirection direction)
{
  GridSize<Dimension> size;
  std::copy_n(engine.View().Cells, Dimension, size.begin());
  ProbePlan<Dimension> plan(size);
  if (direction == FlowDirection::Forward && options.Particles > 0.0)
  {
    plan = ProbePlan<Dimension>(size, options.Particles, options.AreaTolerance);
  }
  if (!engine.HasWholeTables())
  {
    // Ranks exchange the cells of each.
    constexpr std::int64_t few = 10 * SymmetricPlace<3>::Images;
    plan.Blocks = std::min(plan.Blocks, few);
  }
  return plan;
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
    , Plan(planOf(engine, options, direction))
    , Surface(this->Plan.Parts)
    , Probes(engine, direction, this->Plan, this->Work)
  {
    std::copy_n(engine.View().Cells, Dimension, this->Size.begin());
    this->Options.Maps = FlowMaps::Off;
    if (this->IsBackward)
    {
      this->ProbeMass();
    }
    this->Used.resize(this->Probes.Blocks().size());
    std::iota(this->Used.begin(), this->Used.end(), std::size_t{ 0 });
  }

  // `options` are those of the run.
  StepChoice Choose(const FlowOptions& options)
  {
    // Forward the flow expands where it is fast, and no step is too long for that.
    const bool isMap = !this->IsBackward && options.Particles == 0.0;
    if (this->Used.empty() || (isMap && hasLittleContrast<Dimension>(this->Engine, this->Work)))
    {
      return {};
    }
    Images coarse = this->Move(FlowOptions::FewestSteps);
    // The error of photographs with the fewest steps is below.
    const double smooth = this->IsBackward ? 3.0 : 0.3;
    int most = 0; // known when the fewest do not do
    for (Measured now{ FlowOptions::FewestSteps, 0.0 }, before;; now.Steps *= 2)
    {
      Images fine = this->Move(2 * now.Steps);
      const std::vector<double> errors = this->ErrorsOf(coarse, fine);
      now.Error = this->OfNearlyAll(errors);
      if (before.Steps == 0 && now.Error > this->Options.AreaTolerance)
      {
        this->KeepWorst(errors, fine);
        most = this->MostSteps(options, now.Error <= smooth);
      }
      if (now.Error <= this->Options.AreaTolerance || now.Steps >= most ||
        now.Steps == lastCompared)
      {
        return this->ChoiceFrom(before, now, most, options);
      }
      before = now;
      coarse = std::move(fine);
    }
  }

private:
  using Images = std::vector<Point<Dimension>>; // of the points of all blocks in use

  // Where few blocks count, mass is in a small part of the domain: the forward flow leads to it.
  void ProbeMass()
  {
    const std::int64_t wanted = this->Probes.WantedBlocks();
    if (2 * static_cast<std::int64_t>(this->Probes.Blocks().size()) >= wanted)
    {
      return;
    }
    Images places;
    for (std::int64_t number = 0; number < 2 * wanted; ++number)
    {
      const SymmetricPlace<Dimension> place(number);
      Point<Dimension>& point = places.emplace_back();
      for (int axis = 0; axis < Dimension; ++axis)
      {
        point[axis] = place.Real(axis, static_cast<double>(this->Size[axis]));
      }
    }
    this->Move(AdvectionKind::Forward, FlowOptions::FewestSteps, places);
    this->Probes.AddAbout(places, this->Work);
  }

  Images Move(int steps)
  {
    Images points;
    for (const std::size_t block : this->Used)
    {
      const ProbeBlock<Dimension>& of = this->Probes.Blocks()[block];
      for (std::size_t number = 0; number < this->Surface.Count(); ++number)
      {
        points.push_back(this->Surface.At(number, of.Low, of.High));
      }
    }
    this->Move(this->IsBackward ? AdvectionKind::Backward : AdvectionKind::Forward, steps, points);
    return points;
  }

  // Each rank moves a part. Collective.
  void Move(AdvectionKind kind, int steps, Images& points)
  {
    FlowOptions options = this->Options;
    options.NumberOfSteps = steps;
    const auto count = static_cast<std::int64_t>(points.size());
    const Ranks& ranks = this->Work.Group();
    const RankShare share(count, ranks);
    const PointSpan<Dimension> own = PointSpan<Dimension>(points).Part(share.First, share.Count);
    this->Work.BeginStage(0.5 * (1.0 + this->Work.StageEnd())); // how many follow is not known
    this->Engine.Advect(kind, ConstPointSpan<Dimension>(own), own, options, this->Work.Stage());
    gatherParts(ranks, shareStarts(count, Dimension, ranks), points.front().data());
  }

  // Of the blocks in use.
  std::vector<double> ErrorsOf(const Images& coarse, const Images& fine) const
  {
    const SweptMass<Dimension> mass(this->Engine.View(), this->Surface);
    std::vector<double> errors;
    for (std::size_t i = 0; i < this->Used.size(); ++i)
    {
      const Point<Dimension>* before = &coarse[i * this->Surface.Count()];
      const Point<Dimension>* after = &fine[i * this->Surface.Count()];
      const double change = this->IsBackward
        ? imageMeasure<Dimension>(after) - imageMeasure<Dimension>(before)
        : mass.Between(before, after);
      errors.push_back(std::abs(change) / this->Probes.Blocks()[this->Used[i]].Weight);
    }
    return errors;
  }

  // The error that 99.9 % of all blocks keep, if those that are not in use have smaller ones.
  double OfNearlyAll(std::vector<double> errors) const
  {
    constexpr std::size_t oneIn = 1000;
    const std::size_t rank = std::min(this->Probes.Blocks().size() / oneIn, errors.size() - 1);
    const auto found = errors.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(errors.begin(), found, errors.end(), std::greater<double>());
    return *found;
  }

  // More steps are compared for the blocks with the largest errors alone.
  void KeepWorst(const std::vector<double>& errors, Images& images)
  {
    const std::size_t kept = this->KeptBlocks();
    if (kept == this->Used.size())
    {
      return;
    }
    std::vector<std::size_t> order(errors.size());
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    std::stable_sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
    order.resize(kept);
    Images of;
    for (const std::size_t block : order)
    {
      const auto first =
        images.begin() + static_cast<std::ptrdiff_t>(block * this->Surface.Count());
      of.insert(of.end(), first, first + static_cast<std::ptrdiff_t>(this->Surface.Count()));
    }
    images = std::move(of);
    this->Used = std::move(order); // it was every block
  }

  std::size_t KeptBlocks() const
  {
    constexpr std::size_t enough = 256;
    return std::min(enough, this->Probes.Blocks().size());
  }

  StepBudget<Dimension> BudgetOf(const FlowOptions& options) const
  {
    return StepBudget<Dimension>(this->Size, options,
      this->IsBackward ? FlowDirection::Backward : FlowDirection::Forward,
      mapStepsFor<Dimension>(options));
  }

  int MostSteps(const FlowOptions& options, bool isSmooth) const
  {
    const auto each = static_cast<double>(this->Surface.Count());
    if (options.AreaTolerance != FlowOptions::UsualTolerance)
    {
      return FlowOptions::MostSteps;
    }
    const int most =
      this->BudgetOf(options).MostSteps(each * static_cast<double>(this->Probes.Blocks().size()),
        each * static_cast<double>(this->KeptBlocks()), isSmooth);
    // Who needs more steps in any case has a limit as much higher.
    return std::min(FlowOptions::MostSteps, most * (options.LeastSteps / FlowOptions::FewestSteps));
  }

  // `now` keeps the tolerance, or is that of at least `most` steps, or the last that is compared.
  StepChoice ChoiceFrom(
    const Measured& before, const Measured& now, int most, const FlowOptions& options) const
  {
    StepChoice choice;
    const double tolerance = this->Options.AreaTolerance;
    const Integrator integrator = this->Options.Integrator;
    if (before.Steps == 0 && (now.Error <= tolerance || most <= now.Steps))
    {
      choice.NumberOfSteps = now.Steps;
      choice.AreaError = now.Error;
    }
    else if (now.Error <= tolerance || most <= now.Steps)
    {
      choice.NumberOfSteps = before.Steps;
      do
      {
        choice.NumberOfSteps += unit;
        choice.AreaError = errorBetween(before, now, choice.NumberOfSteps);
      } while (choice.NumberOfSteps < std::min(most, now.Steps) && choice.AreaError > tolerance);
    }
    else
    {
      choice.NumberOfSteps =
        std::min(most, stepsFor(now.Error / tolerance, now.Steps, most, integrator));
      choice.AreaError =
        now.Error / fall(static_cast<double>(choice.NumberOfSteps) / now.Steps, integrator);
    }
    const int mapSteps = mapStepsFor<Dimension>(options);
    choice.MapSteps = mapSteps < choice.NumberOfSteps ? mapSteps : 0;
    if (choice.AreaError > tolerance)
    {
      const bool isBelow = now.Error <= tolerance;
      choice.StepsNeeded = isBelow
        ? now.Steps
        : stepsFor(now.Error / tolerance, now.Steps, FlowOptions::MaximumNumberOfSteps, integrator);
      choice.TimesNeeded = this->BudgetOf(options).TimesOf(
        choice, std::min(choice.StepsNeeded, FlowOptions::MaximumNumberOfSteps));
    }
    return choice;
  }

  FlowEngine<Dimension>& Engine;
  FlowOptions Options; // without flow maps
  const bool IsBackward;
  Progress Work;
  const ProbePlan<Dimension> Plan;
  const BlockSurface<Dimension> Surface;
  ProbeBlocks<Dimension> Probes;
  GridSize<Dimension> Size{};
  std::vector<std::size_t> Used; // numbers of blocks
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
  return StepChooser<Dimension>(engine, options, direction, context).Choose(options);
}

template StepChoice chooseSteps<1>(
  FlowEngine<1>&, const FlowOptions&, FlowDirection, const Context&);
template StepChoice chooseSteps<2>(
  FlowEngine<2>&, const FlowOptions&, FlowDirection, const Context&);
template StepChoice chooseSteps<3>(
  FlowEngine<3>&, const FlowOptions&, FlowDirection, const Context&);

} // namespace RectifiedTransport
