// SPDX-License-Identifier: BSD-3-Clause
// Particles that keep their identity through all steps of a series.
#ifndef RectifiedTransport_TrackedParticles_h
#define RectifiedTransport_TrackedParticles_h

#include "Core/Series/SeriesParticles.h"

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

// Equal shares of the mass. They begin as samples of the first step, and each interval's map takes
// all of them together to the next step, so that errors of masses do not add up. Each rank has a
// share.
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

} // namespace RectifiedTransport

#endif
