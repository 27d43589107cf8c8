// SPDX-License-Identifier: BSD-3-Clause
// The particles of an interval between two steps, and their straight ways.
#ifndef RectifiedTransport_MovingParticles_h
#define RectifiedTransport_MovingParticles_h

#include "Bridge/Temporal/MovedClouds.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct StepDensity;

// Of this rank, in the order of their numbers. Those of the first step begin in its cells, with the
// cells' masses, and fade linearly; those of the second step end in its cells and grow. Both sets
// are of one density that moves, so that at both ends it is exactly that of the step.
struct MovingParticles
{
  vtkSmartPointer<vtkDoubleArray> From; // physical, 3 components
  vtkSmartPointer<vtkDoubleArray> To;
  vtkSmartPointer<vtkDoubleArray> Masses; // where they are not faded
  std::vector<std::int64_t> Numbers;      // among those of all ranks; empty on a single rank
  CloudSizes Sizes;                       // empty for points
  std::int64_t OfFirst = 0;               // how many are of the first step
  double Cost = 0.0;                      // the mean over the first step's mass of |To - From|^2
  double Bound = 0.0;                     // of the least cost; 0 without an optimal map
  bool HasBound = false;
  std::string Warning; // why the flow took the place of the optimal map; else empty

  std::int64_t Count() const { return this->From->GetNumberOfTuples(); }
};

struct MovingSettings
{
  int ParticlesPerCell;
  bool IsOptimal;

  bool operator==(const MovingSettings& other) const
  {
    return this->ParticlesPerCell == other.ParticlesPerCell && this->IsOptimal == other.IsOptimal;
  }
};

// If a step has no mass, the particles of the other one stay where they are. Collective. Throws
// Failure and Cancelled.
MovingParticles makeParticles(const StepDensity& from, const StepDensity& to,
  const MovingSettings& settings, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
