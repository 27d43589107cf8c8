// SPDX-License-Identifier: BSD-3-Clause
// Tracked particles of a series whose steps may change.
#ifndef RectifiedTransport_SeriesTracks_h
#define RectifiedTransport_SeriesTracks_h

#include "Core/Series/TrackedParticles.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

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
