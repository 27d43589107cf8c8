// SPDX-License-Identifier: BSD-3-Clause
// The particles of the intervals of a series, moved by the maps between its densities.
#ifndef RectifiedTransport_MovingParticles_h
#define RectifiedTransport_MovingParticles_h

#include "Core/Series/TrackedParticles.h"

#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

struct StepDensity;

struct MovingSettings
{
  int ParticlesPerCell;
  bool IsOptimal;

  bool operator==(const MovingSettings& other) const
  {
    return this->ParticlesPerCell == other.ParticlesPerCell && this->IsOptimal == other.IsOptimal;
  }
};

// Particles of both steps that fade into each other. Collective. Throws Failure and Cancelled.
SeriesParticles makeParticles(const StepDensity& from, const StepDensity& to,
  const MovingSettings& settings, Progress& progress);

// Tracked particles of steps that may change.
class SeriesTracks
{
public:
  // Forgets positions that other settings made.
  void SetSettings(const MovingSettings& settings, int ranks);
  // At how many steps, from the first one on, positions are known.
  int Count() const { return this->Checked; }
  // The steps may have changed: each has to be given again to Extend, which keeps the positions up
  // to the first one that has.
  void Recheck() { this->Checked = 0; }

  // Finds the positions at the next step; `before` is the density of the step before, nullptr at
  // the first one. Both have mass. Returns whether they were not known. Collective. Throws Failure
  // and Cancelled.
  bool Extend(const StepDensity* before, const StepDensity& density, Progress& progress);

  const TrackedParticles& Particles() const { return this->Tracked; }
  // Why the flow took the place of the optimal map at the last Extend; else empty.
  const std::string& Warning() const { return this->Text; }

private:
  template <int D>
  void ExtendBy(const StepDensity* before, const StepDensity& density, Progress& progress);

  MovingSettings Settings{ 0, true };
  int NumberOfRanks = 0;
  TrackedParticles Tracked;
  std::vector<std::shared_ptr<const StepDensity>> Steps; // without their values
  int Checked = 0;                                       // of these
  std::string Text;
};

} // namespace RectifiedTransport::Bridge

#endif
