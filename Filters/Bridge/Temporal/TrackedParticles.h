// SPDX-License-Identifier: BSD-3-Clause
// Particles that keep their identity through all steps of a series.
#ifndef RectifiedTransport_TrackedParticles_h
#define RectifiedTransport_TrackedParticles_h

#include "Bridge/Temporal/MovingParticles.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport
{
class Progress;
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct StepDensity;

// Equal shares of the mass. They begin as samples of the first step, and each interval's map takes
// all of them together to the next step, so that errors of masses do not add up. Of each rank its
// share.
class TrackedParticles
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

  // The particles of the interval from a step to the next one; `to` may be `from`.
  MovingParticles Between(int from, int to, const Ranks& ranks) const;
  // Of all ranks.
  std::int64_t All() const { return this->Particles; }
  // Why the flow took the place of the optimal map at the last Extend; else empty.
  const std::string& Warning() const { return this->Text; }

private:
  template <int D>
  void Begin(const StepDensity& density, Progress& progress);
  template <int D>
  void Follow(const StepDensity& before, const StepDensity& density, Progress& progress);

  struct Step
  {
    std::shared_ptr<const StepDensity> Density; // without its values
    vtkSmartPointer<vtkDoubleArray> Positions;
    double Cost = 0.0; // of the way there
    double Bound = 0.0;
  };

  MovingSettings Settings{ 0, true };
  int NumberOfRanks = 0;
  std::int64_t Particles = 0;
  std::vector<Step> Steps;
  int Checked = 0; // of these
  std::string Text;
};

} // namespace RectifiedTransport::Bridge

#endif
