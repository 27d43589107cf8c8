// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/SeriesTracks.h"

#include "Core/Flow/PivotPositions.h"
#include "Core/Geometry/MeanSquare.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Series/FadingParticles.h"

#include <algorithm>
#include <numeric>

namespace RectifiedTransport
{

void SeriesTracks::SetSettings(const TrackSettings& settings, int ranks)
{
  if (!(this->Chosen == settings) || this->NumberOfRanks != ranks)
  {
    this->Names.clear();
    this->Checked = 0;
  }
  this->Chosen = settings;
  this->NumberOfRanks = ranks;
}

bool SeriesTracks::Knows(const Name& next, const Ranks& ranks)
{
  const auto number = static_cast<std::size_t>(this->Checked);
  // All ranks must agree, as the moves are collective.
  const bool isKnown = number < this->Names.size() && this->Names[number] == next;
  if (onAllRanks(ranks, isKnown))
  {
    ++this->Checked;
    return true;
  }
  this->Names.resize(number);
  this->Tracked.Keep(this->Checked);
  return false;
}

// The first step's particles are samples of its density: the flow moves the pivot lattice, so that
// all particles have the same mass.
template <int D>
void TrackedParticles::Begin(const SeriesStep& step, int perCell, Progress& progress)
{
  const PivotLattice<D> pivot = pivotLattice<D>(step.Grid.Size<D>(), perCell);
  this->Particles = pivot.NumberOfParticles();
  // Each rank tracks its share of the particles, by their numbers.
  const RankShare share(this->Particles, progress.Group());
  const DensityArray<D, double> density(step.Values, step.Grid.Size<D>());
  Stages stages(progress, { { "tables", 2 }, { "positions", 8 } });
  const RectifiedFlow<D> flow(density, stages["tables"]);
  auto positions = std::make_shared<SeriesPositions>(share.Count);
  writePivot<D>(flow, step.Grid, pivot, share, positions->Span(), {}, stages["positions"]);
  this->Steps.assign(1, { positions, {}, 0.0 });
}

template <int D>
void TrackedParticles::Follow(
  const ImageGrid& before, const ImageGrid& grid, const MoveSamples<D>& move, Progress& progress)
{
  Stages stages(progress, { { "start", 1 }, { "move", 96 }, { "images", 3 } });
  const ConstPointSpan<3> from = this->Steps.back().Positions->Span();
  // The particles in the index space of the previous step; rounding may put them outside of its
  // domain.
  LargeBuffer<double> points(from.size() * D);
  stages["start"].ForEach(from.size(), grainOfPositions, [&](std::int64_t i) {
    before.ToIndex<D>(from[i], points.data() + D * i);
    before.ClampToDomain<D>(points.data() + D * i);
  });
  Step step;
  step.Move = move({ points.data(), from.size() }, stages["move"]);
  auto images = std::make_shared<SeriesPositions>(from.size());
  writePhysical<D>(grid, { points.data(), from.size() }, stages["images"], images->Span());
  step.Positions = images;
  // The mean squared displacement over all particles, which have equal masses.
  step.Cost = meanSquare(LengthScale(before), from, step.Positions->Span(), nullptr,
    static_cast<double>(this->Particles), stages["images"]);
  this->Steps.push_back(std::move(step));
}

SeriesParticles TrackedParticles::Between(int from, int to, const Ranks& ranks) const
{
  const Step& first = this->Steps[static_cast<std::size_t>(from)];
  const Step& second = this->Steps[static_cast<std::size_t>(to)];
  SeriesParticles particles;
  particles.AreTracked = true;
  particles.From = first.Positions;
  particles.To = second.Positions;
  particles.OfFirst = first.Positions->Count();
  particles.Masses = LargeBuffer<double>(particles.OfFirst);
  // All particles have the mass 1 / (number of particles), as a share of a step's mass.
  std::fill_n(
    particles.Masses.data(), particles.OfFirst, 1.0 / static_cast<double>(this->Particles));
  // Consecutive numbers, beginning with the rank's share.
  particles.Numbers.resize(static_cast<std::size_t>(particles.OfFirst));
  std::iota(
    particles.Numbers.begin(), particles.Numbers.end(), RankShare(this->Particles, ranks).First);
  if (from != to)
  {
    particles.Cost = second.Cost;
    particles.Bound = second.Move.Bound;
    particles.HasBound = second.Move.HasBound;
  }
  return particles;
}

template void TrackedParticles::Begin<1>(const SeriesStep&, int, Progress&);
template void TrackedParticles::Begin<2>(const SeriesStep&, int, Progress&);
template void TrackedParticles::Begin<3>(const SeriesStep&, int, Progress&);
template void TrackedParticles::Follow<1>(
  const ImageGrid&, const ImageGrid&, const MoveSamples<1>&, Progress&);
template void TrackedParticles::Follow<2>(
  const ImageGrid&, const ImageGrid&, const MoveSamples<2>&, Progress&);
template void TrackedParticles::Follow<3>(
  const ImageGrid&, const ImageGrid&, const MoveSamples<3>&, Progress&);

} // namespace RectifiedTransport
