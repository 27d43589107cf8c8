// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/MovingParticles.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Temporal/IntervalPlan.h"
#include "Bridge/Temporal/StepDensity.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Series/FadingParticles.h"

#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

SeriesStep stepOf(const StepDensity& density)
{
  return { density.Grid, density.Values->GetPointer(0), density.Mass };
}

template <int D>
SeriesParticles make(const StepDensity& from, const StepDensity& to, const MovingSettings& settings,
  Progress& progress)
{
  double bound = 0.0;
  bool hasMoved = false;
  std::string warning;
  const auto move = [&](PointSpan<D> first, PointSpan<D> second, Progress& moving) {
    Stages stages(moving, { { "map", 8 }, { "forward", 1 }, { "backward", 1 } });
    const IntervalPlan<D> plan(from, to, settings.IsOptimal, 0.0, stages["map"]);
    plan.Points().Forward(ConstPointSpan<D>(first), first, stages["forward"]);
    plan.Points().Backward(ConstPointSpan<D>(second), second, stages["backward"]);
    bound = plan.LowerBound();
    warning = plan.Points().Warning();
    hasMoved = true;
  };
  SeriesParticles particles =
    makeFadingParticles<D>(stepOf(from), stepOf(to), settings.ParticlesPerCell, move, progress);
  particles.Bound = bound;
  particles.HasBound = hasMoved && settings.IsOptimal;
  particles.Warning = warning;
  return particles;
}

} // namespace

SeriesParticles makeParticles(const StepDensity& from, const StepDensity& to,
  const MovingSettings& settings, Progress& progress)
{
  const double particles = settings.ParticlesPerCell *
    (static_cast<double>(from.Grid.NumberOfCells()) + static_cast<double>(to.Grid.NumberOfCells()));
  // Positions at both ends and between them, velocities, masses, numbers and vertices.
  constexpr double each = 4.0 * 24.0 + 5.0 * 8.0;
  std::ostringstream purpose;
  purpose.precision(20);
  purpose << particles << " particles (see ParticlesPerCell)";
  const MemoryPlan memory{ purpose.str(), each * particles / progress.Group().Count() };
  return withRequiredMemory(memory, [&]() {
    return dispatchDimension(from.Grid.Dimension(), make<1>, make<2>, make<3>)(
      from, to, settings, progress);
  });
}

void SeriesTracks::SetSettings(const MovingSettings& settings, int ranks)
{
  if (!(this->Settings == settings) || this->NumberOfRanks != ranks)
  {
    this->Steps.clear();
    this->Checked = 0;
  }
  this->Settings = settings;
  this->NumberOfRanks = ranks;
}

bool SeriesTracks::Extend(const StepDensity* before, const StepDensity& density, Progress& progress)
{
  using Self = SeriesTracks;
  this->Text.clear();
  const auto next = static_cast<std::size_t>(this->Checked);
  const bool isKnown = next < this->Steps.size() && this->Steps[next]->IsSameAs(density);
  if (onAllRanks(progress.Group(), isKnown))
  {
    ++this->Checked;
    return false;
  }
  this->Steps.resize(next);
  this->Tracked.Keep(this->Checked);
  const std::int64_t particles = before
    ? this->Tracked.All()
    : density.Grid.NumberOfCells() * static_cast<std::int64_t>(this->Settings.ParticlesPerCell);
  const MemoryPlan memory{ std::to_string(particles) + " particles (see ParticlesPerCell)",
    160.0 * static_cast<double>(particles) / progress.Group().Count() };
  withRequiredMemory(memory, [&]() {
    (this
        ->*dispatchDimension(density.Grid.Dimension(), &Self::ExtendBy<1>, &Self::ExtendBy<2>, &Self::ExtendBy<3>))(
      before, density, progress);
  });
  auto known = std::make_shared<StepDensity>(density);
  known->Values = nullptr;
  this->Steps.push_back(known);
  ++this->Checked;
  return true;
}

template <int D>
void SeriesTracks::ExtendBy(
  const StepDensity* before, const StepDensity& density, Progress& progress)
{
  if (!before)
  {
    this->Tracked.Begin<D>(stepOf(density), this->Settings.ParticlesPerCell, progress);
    return;
  }
  const auto move = [&](PointSpan<D> samples, Progress& moving) -> MoveReport {
    Stages stages(moving, { { "map", 6 }, { "images", 4 } });
    const IntervalPlan<D> plan(*before, density, this->Settings.IsOptimal,
      static_cast<double>(this->Tracked.All()), stages["map"]);
    const FlowSeeds<D> seeds{ ConstPointSpan<D>(samples) };
    plan.Points().Forward(seeds.AsSamples(), samples, stages["images"]);
    this->Text = plan.Points().Warning();
    return { plan.LowerBound(), this->Settings.IsOptimal };
  };
  this->Tracked.Follow<D>(before->Grid, density.Grid, move, progress);
}

} // namespace RectifiedTransport::Bridge
