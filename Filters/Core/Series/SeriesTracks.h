// SPDX-License-Identifier: BSD-3-Clause
// Tracked particles of a series whose steps may change.
#ifndef RectifiedTransport_SeriesTracks_h
#define RectifiedTransport_SeriesTracks_h

#include "Core/Series/SeriesParticles.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace RectifiedTransport
{

// What a map reports after it has moved particles to the next step.
struct MoveReport
{
  double Bound = 0.0; // bounds the mean squared distance from below
  bool HasBound = false;
};

// Moves samples of a step to the next one, from index space to index space. Collective.
template <int D>
using MoveSamples = std::function<MoveReport(PointSpan<D> samples, Progress& progress)>;

// Particles that keep their identity through all steps of a series. They have equal shares of the
// mass. They begin as samples of the first step, and each interval's map takes all of them together
// to the next step, so that errors of masses do not add up. Each rank has a share.
class TrackedParticles
{
public:
  // The number of steps at which positions are known.
  int Count() const { return static_cast<int>(this->Steps.size()); }
  // Forgets the positions from this step on.
  void Keep(int steps) { this->Steps.resize(static_cast<std::size_t>(steps)); }
  // The number of particles on all ranks.
  std::int64_t All() const { return this->Particles; }

  // Places `perCell` particles for each cell of the first step, which has mass. Collective. Throws
  // std::bad_alloc and Cancelled.
  template <int D>
  void Begin(const SeriesStep& step, int perCell, Progress& progress);
  // Finds the positions at the next step. Collective. Throws std::bad_alloc, Cancelled, and what
  // `move` throws.
  template <int D>
  void Follow(
    const ImageGrid& before, const ImageGrid& grid, const MoveSamples<D>& move, Progress& progress);

  // The particles of the interval from a step to the next one; `to` may be `from`.
  SeriesParticles Between(int from, int to, const Ranks& ranks) const;

private:
  struct Step
  {
    std::shared_ptr<const SeriesPositions> Positions;
    MoveReport Move; // there
    double Cost = 0.0;
  };

  std::int64_t Particles = 0;
  std::vector<Step> Steps;
};

struct TrackSettings
{
  int ParticlesPerCell;
  bool IsOptimal;

  bool operator==(const TrackSettings& other) const
  {
    return this->ParticlesPerCell == other.ParticlesPerCell && this->IsOptimal == other.IsOptimal;
  }
};

class SeriesTracks
{
public:
  using Name = std::vector<std::uint64_t>; // the same numbers for equal densities alone

  // Forgets positions that other settings made.
  void SetSettings(const TrackSettings& settings, int ranks);
  const TrackSettings& Settings() const { return this->Chosen; }
  // Returns the number of steps, from the first one on, at which positions are known.
  int Count() const { return this->Checked; }
  // The steps may have changed: each has to be given again to Knows, which keeps the positions up
  // to the first one that has.
  void Recheck() { this->Checked = 0; }
  // Returns whether the positions at the next step, which has this name, are known on all ranks;
  // they then count. Otherwise forgets the positions from this step on. Collective.
  bool Knows(const Name& next, const Ranks& ranks);

  // Finds the positions at the next step, which are not known; `before` is the grid of the step
  // before, nullptr at the first one. Both have mass. Collective. Throws as TrackedParticles.
  template <int D>
  void Extend(const ImageGrid* before, const SeriesStep& step, const Name& name,
    const MoveSamples<D>& move, Progress& progress)
  {
    before ? this->Tracked.Follow<D>(*before, step.Grid, move, progress)
           : this->Tracked.Begin<D>(step, this->Chosen.ParticlesPerCell, progress);
    this->Names.push_back(name);
    ++this->Checked;
  }

  const TrackedParticles& Particles() const { return this->Tracked; }

private:
  TrackSettings Chosen{ 0, true };
  int NumberOfRanks = 0;
  TrackedParticles Tracked;
  std::vector<Name> Names; // name of each step
  int Checked = 0;         // steps that were checked since Recheck
};

} // namespace RectifiedTransport

#endif
