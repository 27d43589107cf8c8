// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Steps/AutomaticSteps.h"

#include "Core/Flow/Steps/LowContrast.h"
#include "Core/Flow/Steps/ProbeBlocks.h"
#include "Core/Flow/Steps/StepBudget.h"
#include "Core/Flow/Steps/SweptMass.h"
#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"

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

constexpr int lastCompared = 1024; // steps, with twice as many

// The error that 99.9 % of the blocks keep is that of the worst after one in a thousand.
constexpr std::size_t oneIn = 1000;

// A choice is verified by the worse half of the blocks, each time with more points on their sides.
// Among those with the largest changes, `Retained` for each that may be worse stay.
struct Verification
{
  int Parts;  // of a side
  int Factor; // so many times the steps
  std::size_t Retained;
};
constexpr Verification verifications[] = { { 1, 2, 32 }, { 2, 2, 8 }, { 4, 4, 0 } };

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
    found += stepUnit;
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
  // Errors of 0 have no logarithm; this one is below any tolerance.
  constexpr double least = 1e-9;
  const double logOfFew = naturalLogarithm(std::max(few.Error, least));
  const double logOfMany = naturalLogarithm(std::max(many.Error, least));
  const double fraction = naturalLogarithm(static_cast<double>(steps) / few.Steps) /
    naturalLogarithm(static_cast<double>(many.Steps) / few.Steps);
  return exponential(logOfFew + fraction * (logOfMany - logOfFew));
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

// Forward, a given number of particles decides how small the blocks can be in which an error shows.
// Without whole tables there are fewer blocks.
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
    plan.Spread(10 * SymmetricPlace<3>::Images);
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
    , Direction(direction)
    , Work(context)
    , Plan(planOf(engine, options, direction))
    , Surface(this->Plan.Parts)
    , Probes(engine, direction, this->Plan, this->Parts.Next())
  {
    std::copy_n(engine.View().Cells, Dimension, this->Size.begin());
    this->Options.Maps = FlowMaps::Off;
    if (this->IsBackward())
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
    if (this->Used.empty() ||
      (this->IsMap() && !this->IsBackward() && hasLowContrast<Dimension>(this->Engine, this->Work)))
    {
      return {};
    }
    // Richardson's idea: the difference of images in N and 2 N steps is about the error of N. N
    // doubles until that of nearly all blocks is within the tolerance.
    Images coarse = this->Move(FlowOptions::FewestSteps);
    // The error of photographs with the fewest steps is below.
    const double smooth = this->IsBackward() ? 3.0 : 0.3;
    int most = 0; // known when the fewest do not do
    for (Measured now{ FlowOptions::FewestSteps, 0.0 }, before;; now.Steps *= 2)
    {
      Images fine = this->Move(2 * now.Steps);
      const std::vector<double> errors = this->ErrorsOf(coarse, fine);
      now.Error = this->OfNearlyAll(errors);
      const bool isKept = now.Error <= this->Options.AreaTolerance;
      if (before.Steps == 0 && !isKept)
      {
        std::vector<std::size_t> worst = this->SelectWorst(errors, (errors.size() + 1) / 2);
        // The half with larger errors is what a verification looks at again.
        this->Worse = this->Used;
        // Further comparisons take the worst blocks alone: errors of others are smaller, and fall
        // too.
        constexpr std::size_t compared = 256;
        worst.resize(std::min(compared, worst.size()));
        this->Used.resize(worst.size());
        fine = this->Select(fine, worst);
        most = this->MostSteps(options, now.Error <= smooth);
      }
      if (isKept || now.Steps >= most || now.Steps == lastCompared)
      {
        StepChoice choice = this->ChoiceFrom(before, now, most);
        if (this->IsVerified() && before.Steps > 0 && options.LeastSteps <= choice.NumberOfSteps)
        {
          this->Verify(choice, most, options);
        }
        this->Complete(choice, options);
        return choice;
      }
      before = now;
      coarse = std::move(fine);
    }
  }

private:
  using Images = std::vector<Point<Dimension>>; // the points of all blocks in use

  bool IsBackward() const { return this->Direction == FlowDirection::Backward; }
  bool IsMap() const { return this->IsBackward() || this->Options.Particles == 0.0; }
  bool IsVerified() const { return this->IsMap() && this->Options.NeedsEstimate; }

  // Where few blocks count, mass is in a small part of the domain: the forward flow leads to it.
  void ProbeMass()
  {
    const std::int64_t wanted = this->Probes.WantedBlocks();
    if (2 * static_cast<std::int64_t>(this->Probes.Blocks().size()) >= wanted)
    {
      return;
    }
    // Low-discrepancy places of the uniform measure go to where the mass is.
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
    this->Probes.AddAbout(places, this->Parts.Next());
  }

  // The points on the surfaces of blocks, block by block.
  Images PointsOf(const std::vector<std::size_t>& blocks) const
  {
    Images points;
    for (const std::size_t block : blocks)
    {
      const ProbeBlock<Dimension>& of = this->Probes.Blocks()[block];
      for (std::size_t number = 0; number < this->Surface.Count(); ++number)
      {
        points.push_back(this->Surface.At(number, of.Low, of.High));
      }
    }
    return points;
  }

  // Blocks beside each other share the points of their common side, which then move once.
  DistinctPoints<Dimension> Distinct(const Images& points) const
  {
    return DistinctPoints<Dimension>(points, this->Work.Threads());
  }

  Images Move(int steps)
  {
    Images points = this->PointsOf(this->Used);
    const DistinctPoints<Dimension> distinct = this->Distinct(points); // blocks share points
    Images images = distinct.Places();
    this->Move(
      this->IsBackward() ? AdvectionKind::Backward : AdvectionKind::Forward, steps, images);
    this->Spent += static_cast<double>(images.size()) * steps;
    distinct.Move(images, points);
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
    this->Engine.Advect(kind, ConstPointSpan<Dimension>(own), own, options, this->Parts.Next());
    gatherParts(ranks, shareStarts(count, Dimension, ranks), points.front().data());
  }

  // The relative errors of the blocks in use: the mass (or area) that their surfaces sweep between
  // images in few and in more steps, over the block's weight.
  std::vector<double> ErrorsOf(const Images& coarse, const Images& fine) const
  {
    const SweptMass<Dimension> mass(this->Engine.View(), this->Surface, this->IsBackward());
    std::vector<double> errors;
    for (std::size_t i = 0; i < this->Used.size(); ++i)
    {
      const std::size_t first = i * this->Surface.Count();
      errors.push_back(std::abs(mass.Between(&coarse[first], &fine[first])) /
        this->Probes.Blocks()[this->Used[i]].Weight);
    }
    return errors;
  }

  // The error that 99.9 % of all blocks keep, if those that are not in use have smaller ones.
  double OfNearlyAll(std::vector<double> errors) const
  {
    const std::size_t rank = std::min(this->Worst(), errors.size() - 1);
    const auto found = errors.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(errors.begin(), found, errors.end(), std::greater<double>());
    return *found;
  }

  // Only blocks with the largest errors stay in use. Returns which of them, in that order.
  std::vector<std::size_t> SelectWorst(const std::vector<double>& errors, std::size_t most)
  {
    std::vector<std::size_t> order(errors.size());
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    std::stable_sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
    order.resize(std::min(most, order.size()));
    std::vector<std::size_t> used;
    for (const std::size_t number : order)
    {
      used.push_back(this->Used[number]);
    }
    this->Used = std::move(used);
    return order;
  }

  // The images of some of the blocks.
  Images Select(const Images& images, const std::vector<std::size_t>& blocks) const
  {
    Images of;
    for (const std::size_t block : blocks)
    {
      const auto count = static_cast<std::ptrdiff_t>(this->Surface.Count());
      const auto first = images.begin() + static_cast<std::ptrdiff_t>(block) * count;
      of.insert(of.end(), first, first + count);
    }
    return of;
  }

  // How many blocks may have larger errors than nearly all.
  std::size_t Worst() const { return this->Probes.Blocks().size() / oneIn; }

  StepBudget<Dimension> BudgetOf(const FlowOptions& options) const
  {
    return StepBudget<Dimension>(
      this->Size, options, this->Direction, mapStepsFor<Dimension>(options));
  }

  // The most steps that the usual tolerance may choose, so that choosing and advecting stay within
  // the budget. Another tolerance is a wish for accuracy and has no such limit.
  int MostSteps(const FlowOptions& options, bool isSmooth) const
  {
    if (options.AreaTolerance != FlowOptions::UsualTolerance)
    {
      return FlowOptions::MostSteps;
    }
    typename StepBudget<Dimension>::ChoiceCost choosing{ this->Spent,
      static_cast<double>(this->Distinct(this->PointsOf(this->Used)).Places().size()), 0.0 };
    if (this->IsVerified())
    {
      std::size_t points = this->Distinct(this->PointsOf(this->Worse)).Places().size();
      for (const Verification& verification : verifications)
      {
        // A verification moves its points with the chosen steps and with `Factor` times as many.
        choosing.Verified += static_cast<double>((verification.Factor + 1) * points);
        const BlockSurface<Dimension> next(2 * verification.Parts);
        points = verification.Retained * (this->Worst() + 1) * next.Count();
      }
    }
    const int most = this->BudgetOf(options).MostSteps(choosing, isSmooth);
    // Who needs more steps in any case has a limit as much higher.
    return std::min(FlowOptions::MostSteps, most * (options.LeastSteps / FlowOptions::FewestSteps));
  }

  // `now` keeps the tolerance, or is that of at least `most` steps, or the last that is compared.
  StepChoice ChoiceFrom(const Measured& before, const Measured& now, int most) const
  {
    StepChoice choice;
    const double tolerance = this->Options.AreaTolerance;
    if (before.Steps == 0)
    {
      choice.NumberOfSteps = now.Steps;
      choice.AreaError = now.Error;
    }
    else if (now.Error <= tolerance || most <= now.Steps)
    {
      // The least number between the last two whose interpolated error keeps the tolerance.
      choice.NumberOfSteps = before.Steps;
      do
      {
        choice.NumberOfSteps += stepUnit;
        choice.AreaError = errorBetween(before, now, choice.NumberOfSteps);
      } while (choice.NumberOfSteps < std::min(most, now.Steps) && choice.AreaError > tolerance);
    }
    else
    {
      choice.NumberOfSteps = now.Steps;
      choice.AreaError = now.Error;
      this->TakeMore(choice, most);
    }
    return choice;
  }

  // As many as the tolerance needs if errors fall as expected, but no more than `most`.
  void TakeMore(StepChoice& choice, int most) const
  {
    const Integrator integrator = this->Options.Integrator;
    const int steps = std::min(std::max(most, choice.NumberOfSteps),
      stepsFor(
        choice.AreaError / this->Options.AreaTolerance, choice.NumberOfSteps, most, integrator));
    choice.AreaError /= fall(static_cast<double>(steps) / choice.NumberOfSteps, integrator);
    choice.NumberOfSteps = steps;
  }

  // With the steps that are chosen, as one particle a cell takes them: errors go up and down from
  // one number of steps to the next, and fall slowly where a density jumps. Then twice as many do
  // not show them, but 4 times as many do. Between the corners of cells the sides of a block bend.
  void Verify(StepChoice& choice, int most, const FlowOptions& options)
  {
    this->TakeMapSteps(choice, options);
    FlowOptions taken = this->Options;
    if (this->Engine.HasWholeTables())
    {
      taken = withFlowMaps<Dimension>(
        choice.Of(options), this->Size, this->Direction, numberOfCells<Dimension>(this->Size));
    }
    this->Used = this->Worse;
    for (const Verification& verification : verifications)
    {
      this->Surface = BlockSurface<Dimension>(verification.Parts);
      std::swap(taken, this->Options);
      const Images images = this->Move(choice.NumberOfSteps);
      std::swap(taken, this->Options);
      const int more =
        std::min(verification.Factor * choice.NumberOfSteps, FlowOptions::MaximumNumberOfSteps);
      const std::vector<double> errors = this->ErrorsOf(images, this->Move(more));
      choice.AreaError = this->OfNearlyAll(errors);
      this->SelectWorst(errors, verification.Retained * (this->Worst() + 1));
    }
    this->TakeMore(choice, most);
  }

  // Flow maps need no more steps than give their smooth part; 0: as many as particles.
  void TakeMapSteps(StepChoice& choice, const FlowOptions& options) const
  {
    const int mapSteps = mapStepsFor<Dimension>(options);
    choice.MapSteps = mapSteps < choice.NumberOfSteps ? mapSteps : 0;
  }

  // What a warning needs to say if the tolerance is not kept: how many steps would, and at what
  // cost.
  void Complete(StepChoice& choice, const FlowOptions& options) const
  {
    this->TakeMapSteps(choice, options);
    if (choice.AreaError > this->Options.AreaTolerance)
    {
      choice.StepsNeeded = stepsFor(choice.AreaError / this->Options.AreaTolerance,
        choice.NumberOfSteps, FlowOptions::MaximumNumberOfSteps, this->Options.Integrator);
      choice.TimesNeeded = this->BudgetOf(options).TimesOf(
        choice, std::min(choice.StepsNeeded, FlowOptions::MaximumNumberOfSteps));
    }
  }

  FlowEngine<Dimension>& Engine;
  FlowOptions Options; // without flow maps
  const FlowDirection Direction;
  Progress Work;
  Rounds Parts{ this->Work, 1 }; // choices of blocks and advections; their number is not known
  const ProbePlan<Dimension> Plan;
  BlockSurface<Dimension> Surface;
  ProbeBlocks<Dimension> Probes;
  GridSize<Dimension> Size{};
  std::vector<std::size_t> Used;  // numbers of blocks
  std::vector<std::size_t> Worse; // the half with the larger errors in the first comparison
  double Spent = 0.0;             // velocities
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

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(chooseSteps);

} // namespace RectifiedTransport
