// SPDX-License-Identifier: BSD-3-Clause
// The particles of an interval between two steps of a series, and where they are at a moment.
#ifndef RectifiedTransport_SeriesParticles_h
#define RectifiedTransport_SeriesParticles_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Splat/ScaledClouds.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// Physical points, which several intervals may share.
class SeriesPositions
{
public:
  explicit SeriesPositions(std::int64_t count)
    : Coordinates(3 * count)
  {
  }
  std::int64_t Count() const { return this->Coordinates.size() / 3; }
  ConstPointSpan<3> Span() const { return { this->Coordinates.data(), this->Count() }; }
  PointSpan<3> Span() { return { this->Coordinates.data(), this->Count() }; }

private:
  LargeBuffer<double> Coordinates;
};

// The density of one step.
struct SeriesStep
{
  const ImageGrid& Grid;
  const double* Values; // one per cell, axis 0 of index space fastest
  double Mass;          // density times cell measure, summed; may be 0
};

// The particles of this rank, in the order of their numbers.
struct SeriesParticles
{
  std::shared_ptr<const SeriesPositions> From;
  std::shared_ptr<const SeriesPositions> To;
  LargeBuffer<double> Masses;        // where they are not faded
  std::vector<std::int64_t> Numbers; // among those of all ranks; may be empty on a single rank
  // Tracked particles belong to both steps. Otherwise, the first OfFirst particles belong to the
  // first step and fade; the rest belongs to the second step and grows.
  bool AreTracked = false;
  std::int64_t OfFirst = 0;
  // Lengths of the clouds along the axes of index space at both ends of the way, interleaved, in
  // lengths of the cells of the particle's own step, so that no unit of physical lengths is beyond
  // a float. Empty for points.
  std::array<std::vector<float>, 2> Clouds;
  std::array<ImageGrid, 2> Grids; // those of both steps, where there are clouds
  double Cost = 0.0;              // the mean over the first step's mass of |To - From|^2
  double Bound = 0.0;             // lower bound of the least cost; 0 without an optimal map
  bool HasBound = false;
  std::string Warning; // why the flow took the place of the optimal map; else empty

  std::int64_t Count() const { return this->From->Count(); }
};

// The velocities on straight ways that take a time; 0 for a time of 0. Returns whether all are
// finite. Throws Cancelled.
bool writeVelocities(
  const SeriesParticles& particles, double time, PointSpan<3> velocities, Progress& progress);

// The particles of an interval that have mass at a moment: at its ends those of one step alone.
class SeriesSnapshot
{
public:
  // `part` is the part of the way that is done. The particles must outlive this object.
  SeriesSnapshot(const SeriesParticles& particles, double part);

  const SeriesParticles& All() const { return this->Particles; }
  double Part() const { return this->TimeFraction; }
  std::int64_t First() const { return this->Begin; } // among all
  std::int64_t Count() const { return this->Places.size(); }

  // Writes the positions on their straight ways, and the faded masses; tracked particles have
  // shares of `mass`. Both must outlive this object. Throws Cancelled.
  void Write(double mass, PointSpan<3> points, double* masses, Progress& progress);
  // What Write has written.
  ConstPointSpan<3> Points() const { return this->Places; }
  const double* Masses() const { return this->MassesOfPoints; }
  // The numbers among the particles of all ranks; null if there are none.
  const std::int64_t* Numbers() const;

  template <int D>
  ScaledClouds<D> CloudsIn(const ImageGrid& grid) const;

private:
  const SeriesParticles& Particles;
  const double TimeFraction;
  const std::int64_t Begin;
  ConstPointSpan<3> Places;
  const double* MassesOfPoints = nullptr;
};

} // namespace RectifiedTransport

#endif
