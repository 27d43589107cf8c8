// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/SeriesParticles.h"

#include "Core/Flow/WeightedMean.h"
#include "Core/Geometry/PhysicalPoints.h"
#include "Core/Series/CloudLengths.h"

#include <atomic>
#include <cmath>

namespace RectifiedTransport
{

bool writeVelocities(
  const SeriesParticles& particles, double time, PointSpan<3> velocities, Progress& progress)
{
  const double* from = particles.From->Span().data();
  const double* to = particles.To->Span().data();
  double* v = velocities.data();
  std::atomic<bool> areFinite{ true };
  progress.For(3 * velocities.size(), grainOfPositions, [&](std::int64_t first, std::int64_t last) {
    bool isFinite = true;
    for (std::int64_t i = first; i < last; ++i)
    {
      // Ways are straight and of constant speed.
      v[i] = time > 0.0 ? (to[i] - from[i]) / time : 0.0;
      isFinite = isFinite && std::isfinite(v[i]);
    }
    if (!isFinite)
    {
      areFinite = false;
    }
  });
  return areFinite;
}

// At the ends of the interval, particles of the other step have no mass and are left out.
SeriesSnapshot::SeriesSnapshot(const SeriesParticles& particles, double part)
  : Particles(particles)
  , TimeFraction(part)
  , Begin(!particles.AreTracked && part >= 1.0 ? particles.OfFirst : 0)
  , Places(nullptr, (part <= 0.0 ? particles.OfFirst : particles.Count()) - this->Begin)
{
}

// Straight ways, x(s) = (1 - s) from + s to: displacement interpolation. Masses fade by 1 - s and
// grow by s.
void SeriesSnapshot::Write(double mass, PointSpan<3> points, double* masses, Progress& progress)
{
  const double part = this->TimeFraction;
  const std::int64_t count = this->Count();
  // Positions at both ends of the way, with the weights 1 - s and s.
  const std::vector<WeightedPositions> ends = {
    { this->Particles.From->Span().Part(this->Begin, count), 1.0 - part },
    { this->Particles.To->Span().Part(this->Begin, count), part }
  };
  // Masses are for whole particles; tracked ones have shares of the mass at the moment.
  const double ofFirst = this->Particles.AreTracked ? mass : 1.0 - part;
  const double* whole = this->Particles.Masses.data() + this->Begin;
  // The first particle of the second step, among those that have mass.
  const std::int64_t second = this->Particles.OfFirst - this->Begin;
  progress.For(count, grainOfPositions, [&](std::int64_t first, std::int64_t last) {
    writeWeightedMean(ends, first, last, points);
    for (std::int64_t i = first; i < last; ++i)
    {
      masses[i] = whole[i] * (i < second ? ofFirst : part);
    }
  });
  this->Places = points;
  this->MassesOfPoints = masses;
}

const std::int64_t* SeriesSnapshot::Numbers() const
{
  const std::vector<std::int64_t>& numbers = this->Particles.Numbers;
  return numbers.empty() ? nullptr : numbers.data() + this->Begin;
}

template <int D>
ScaledClouds<D> SeriesSnapshot::CloudsIn(const ImageGrid& grid) const
{
  ScaledClouds<D> clouds{ this->Places, this->MassesOfPoints, {}, this->TimeFraction, {},
    this->Particles.OfFirst - this->Begin };
  for (std::size_t end = 0; end < 2 && !this->Particles.Clouds[0].empty(); ++end)
  {
    // Lengths are in cells of the particle's own step, so they need a unit for each step's grid.
    clouds.Lengths[end] = this->Particles.Clouds[end].data() + D * this->Begin;
    clouds.Units[end] = cellsInCells<D>(this->Particles.Grids[end], grid);
  }
  return clouds;
}

template ScaledClouds<1> SeriesSnapshot::CloudsIn<1>(const ImageGrid&) const;
template ScaledClouds<2> SeriesSnapshot::CloudsIn<2>(const ImageGrid&) const;
template ScaledClouds<3> SeriesSnapshot::CloudsIn<3>(const ImageGrid&) const;

} // namespace RectifiedTransport
